// Puts the page together and keeps it up to date.
import { Connection } from './connection';
import { find, setText, toast } from './dom';
import { Commands } from './panels/commands';
import { EventList } from './panels/events';
import { HealthPanel } from './panels/health';
import { RunList } from './panels/runs';
import { Timeline } from './panels/timeline';
import { TopBar } from './panels/topbar';
import { Player } from './player';
import { Charts } from './plots/charts';
import { JointTable } from './plots/joints';
import { Plane } from './plots/plane';
import type { Answer, Block, Model, RunDocument, RunEntry, RunEvent, Status, Step } from './protocol';
import { Drag } from './scene/drag';
import type { View3D } from './scene/view';
import { heading, Stage } from './stage';
import { FinishedRun, footprints, LiveRun, type Source } from './sources';
import { toolbar } from './toolbar';

const PLOT_MS = 70; // least between two drawings of a plot
const PLOTS_A_PICTURE = 2;
const PANEL_MS = 180;

export class App {
  readonly player: Player;
  readonly live: LiveRun;
  source: Source;
  status: Status | null = null;
  readonly charts: Charts;
  readonly plane: Plane;
  private readonly connection: Connection;
  private readonly topbar: TopBar;
  private readonly runs: RunList;
  private readonly commands: Commands;
  private readonly health: HealthPanel;
  private readonly events: EventList;
  private readonly timeline: Timeline;
  private readonly joints: JointTable;
  private readonly drag: Drag | null;
  private readonly stage: Stage | null;
  private lastFrame_ms = 0;
  private readonly plotted_ms: number[];
  private turn = 0;
  private lastPanel_ms = 0;
  private frames: number[] = [];
  private wanted = 'live';

  constructor(
    model: Model,
    private readonly view: View3D | null,
  ) {
    this.live = new LiveRun(model.layout);
    this.source = this.live;
    this.player = new Player(this.live.track);
    this.stage = view ? new Stage(view, model, this.player) : null;
    this.topbar = new TopBar(model);
    this.runs = new RunList(
      () => this.showLive(),
      (entry) => void this.showRun(entry),
    );
    this.commands = new Commands(model, (command, name, value) => this.command(command, name, value));
    this.health = new HealthPanel(model);
    this.events = new EventList((t) => this.player.seek(t));
    this.timeline = new Timeline(this.player);
    this.joints = new JointTable(model, () => this.charts.pickJoints());
    this.plane = new Plane(model);
    this.charts = new Charts(this.player, model, () => this.joints.picked);
    this.plotted_ms = Array(this.charts.count + 1).fill(0);
    find('left').append(this.runs.element, this.commands.element);
    find('right').append(this.plane.element, ...this.charts.elements);
    find('below').append(this.joints.element, this.health.element, this.events.element);
    if (view) find('view').append(toolbar(view, () => this.yaw()));
    this.drag = view ? this.makeDrag(view) : null;
    this.connection = new Connection({
      message: (message) => this.told(message),
      block: (block) => this.block(block),
      open: () => void this.runs.refresh(),
      lost: () => this.view?.invalidate(),
    });
    requestAnimationFrame((now) => this.frame(now));
  }

  // ---------------------------------------------------------------- what is shown

  private show(source: Source): void {
    this.source = source;
    this.player.show(source.track, source.live);
    this.events.reset(source.events);
    document.body.classList.toggle('replay', !source.live);
    this.showGround();
    this.runs.select(source.id);
  }

  private showGround(): void {
    if (!this.view) return;
    const { soil, terrain } = this.source;
    this.view.setSoil(soil);
    this.view.ground.build(terrain, soil?.grid ?? null);
    this.stage?.reset();
    find('soil-scale').hidden = soil === null;
    if (soil) setText(find('soil-depth'), `${(1000 * soil.grid.full_scale_m).toFixed(0)} mm`);
  }

  showLive(): void {
    this.wanted = 'live';
    this.show(this.live);
  }

  async showRun(entry: RunEntry): Promise<void> {
    this.wanted = entry.id;
    find('loading').hidden = false;
    try {
      const run = await FinishedRun.load(entry);
      if (this.wanted === entry.id) this.show(run);
    } catch (error) {
      toast(`${entry.id} cannot be shown: ${(error as Error).message}`);
    } finally {
      find('loading').hidden = true;
    }
  }

  private yaw(): number {
    return this.source.terrain?.start_yaw_W_rad ?? 0;
  }

  // ---------------------------------------------------------------- live

  private told(message: { kind: string }): void {
    const { live } = this;
    switch (message.kind) {
      case 'status':
        this.status = message as Status;
        break;
      case 'run':
        this.runTold(message as never);
        break;
      case 'step':
        live.step((message as unknown as { step: Step }).step);
        break;
      case 'start_feet':
        live.startFeet = (message as unknown as LiveRun & { start_feet: [] }).start_feet;
        break;
      case 'event':
        this.event(message as unknown as RunEvent & { kind: string });
        break;
      case 'answer':
        this.commands.answer(message as unknown as Answer);
        break;
      case 'late':
        toast('This page did not keep up with the run; it starts again from what is there.');
        break;
    }
  }

  private runTold(told: {
    run_id: string;
    document: RunDocument | null;
    steps: Step[];
    start_feet: [];
    events: RunEvent[];
  }): void {
    this.live.begin(told);
    if (told.document) this.commands.setValues(told.document.controller);
    if (told.document && !told.document.same_schema) {
      toast(`The run is of another version (${told.document.version}) than this monitor; what differs is not shown.`);
    }
    if (this.source === this.live) this.show(this.live);
  }

  private event(event: RunEvent): void {
    const { t_s, event: kind, text } = event;
    const told = { t_s, event: kind, text };
    this.live.event(told);
    if (this.source === this.live) this.events.add(told);
  }

  private block(block: Block): void {
    if (block.header.kind === 'rows') this.live.rows(block);
    else if (this.live.soilTold(block) && this.source === this.live) this.showGround();
    if (this.source === this.live) this.view?.invalidate();
  }

  private command(command: string, name: string, value: number[]): void {
    if (this.connection.send({ command, name, value })) return;
    this.commands.answer({
      kind: 'answer',
      accepted: false,
      reason: 'the monitor does not answer',
      command,
      name,
      value,
      own: true,
    });
  }

  // Why no command can be given now, or nothing.
  private why(): string {
    if (!this.source.live) return 'A finished run takes no commands.';
    if (!this.connection.connected) return 'No server.';
    const state = this.status?.state ?? 'waiting';
    if (state === 'off' || state === 'waiting') return 'No run. ./hoap2 run floor-walk --realtime --accept-commands';
    if (state === 'ended') return 'The run has ended.';
    if (this.live.document && !this.live.document.accepts_commands)
      return 'This run was started without --accept-commands.';
    return '';
  }

  private makeDrag(view: View3D): Drag {
    const drag = new Drag({
      canvas: view.canvas,
      camera: view.camera.camera,
      grip: () => view.robot.grip,
      allowed: () => this.commands.enabled,
      limit_N: () => this.commands.drag_N,
      hold: (held) => (view.camera.controls.enabled = !held),
      redraw: () => view.invalidate(),
      push: (force) => this.commands.pushBy(force),
    });
    view.scene.add(drag.arrow.group);
    return drag;
  }

  // ---------------------------------------------------------------- each picture

  private frame(now_ms: number): void {
    requestAnimationFrame((next) => this.frame(next));
    const dt_s = Math.min(0.25, (now_ms - this.lastFrame_ms) / 1000);
    this.lastFrame_ms = now_ms;
    this.player.tick(dt_s);
    this.timeline.update(this.source.steps, this.events.all);
    if (this.view) {
      this.stage?.update(this.source);
      if (this.view.draw(now_ms, dt_s)) this.frames.push(now_ms);
    }
    this.plots(now_ms);
    if (now_ms - this.lastPanel_ms >= PANEL_MS) {
      this.lastPanel_ms = now_ms;
      this.panels(now_ms);
    }
  }

  // A few of the plots in turn, so that no picture waits for all of them.
  private plots(now_ms: number): void {
    for (let i = 0; i < PLOTS_A_PICTURE; i++) {
      if (now_ms - this.plotted_ms[this.turn] < PLOT_MS) return;
      this.plotted_ms[this.turn] = now_ms;
      if (this.turn < this.charts.count) this.charts.update(this.turn);
      else this.drawPlane();
      this.turn = (this.turn + 1) % this.plotted_ms.length;
    }
  }

  private drawPlane(): void {
    const { track, time } = this.player;
    const prints = track.count ? footprints(this.source, track.find(time + 1e-9)) : [];
    this.plane.update(track, time, prints, this.yaw());
  }

  private panels(now_ms: number): void {
    const { track, time } = this.player;
    this.frames = this.frames.filter((t) => now_ms - t < 1000);
    const row = track.count ? track.find(time + 1e-9) : 0;
    const { source, status } = this;
    this.topbar.update(
      {
        live: source.live,
        connected: this.connection.connected,
        title: source.title,
        status,
        speed: this.player.speed,
        playing: this.player.playing,
        fps: this.frames.length,
      },
      track,
      row,
      time,
    );
    if (source instanceof FinishedRun) this.health.finished(source.id, source.summary, track.value(row, 'fault'));
    else this.health.live(status);
    if (!source.live || !this.player.playing) this.events.at(time);
    this.joints.update(track, row);
    // only the newest ground of a live run is known
    setText(find('soil-note'), source.live && !this.player.playing ? 'sinkage as it is now' : 'sinkage');
    const why = this.why();
    this.commands.enable(why === '', why);
    this.commands.setHeading(track.count ? heading(track.values(row, 'true_base_quat_W')) : this.yaw());
    this.runs.setLive(status, this.live.document?.scenario ?? '');
  }

  // For tests and measurements.
  get probe(): Record<string, unknown> {
    return {
      rows: this.player.track.count,
      time: this.player.time,
      last: this.player.track.last,
      playing: this.player.playing,
      pictures: this.view?.pictures ?? 0,
      fps: this.frames.length,
      tier: this.view?.quality.tier ?? -1,
      charts: this.charts.updates,
      plane: this.plane.updates,
      state: this.status?.state,
      live: this.source.live,
      run: this.source.id,
      steps: this.source.steps.length,
      lost: Object.values(this.status?.counters ?? {}).reduce((sum, counter) => sum + counter.lost, 0),
      dragging: this.drag !== null,
    };
  }

  pixels(): ReturnType<View3D['pixels']> | undefined {
    return this.view?.pixels();
  }
}
