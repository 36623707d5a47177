// The WebSocket to the server: comes back by itself when it is lost.
import { unpack, type Block } from './protocol';

const FIRST_WAIT_MS = 300;
const LONGEST_WAIT_MS = 4000;

export interface Handlers {
  message: (message: { kind: string }) => void;
  block: (block: Block) => void;
  open: () => void;
  lost: () => void;
}

export class Connection {
  private socket: WebSocket | null = null;
  private wait_ms = FIRST_WAIT_MS;
  connected = false;

  constructor(private readonly handlers: Handlers) {
    this.open();
  }

  private open(): void {
    const scheme = location.protocol === 'https:' ? 'wss:' : 'ws:';
    const socket = new WebSocket(`${scheme}//${location.host}/ws`);
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => {
      this.connected = true;
      this.wait_ms = FIRST_WAIT_MS;
      this.handlers.open();
    };
    socket.onmessage = (event: MessageEvent<string | ArrayBuffer>) => {
      if (typeof event.data === 'string') this.handlers.message(JSON.parse(event.data));
      else this.handlers.block(unpack(event.data));
    };
    socket.onclose = () => {
      if (this.connected) this.handlers.lost();
      this.connected = false;
      setTimeout(() => this.open(), this.wait_ms);
      this.wait_ms = Math.min(LONGEST_WAIT_MS, this.wait_ms * 1.7);
    };
    this.socket = socket;
  }

  // False when there is no server to send to.
  send(message: object): boolean {
    if (!this.connected || !this.socket) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }
}
