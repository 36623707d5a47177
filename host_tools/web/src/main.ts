// The page of ./hoap2 monitor --web.
import 'uplot/dist/uPlot.min.css';
import './style.css';
import * as api from './api';
import { App } from './app';
import { find, setText } from './dom';
import { View3D } from './scene/view';
import { legend } from './toolbar';

async function view(model: Awaited<ReturnType<typeof api.model>>): Promise<View3D | null> {
  const [fine, coarse] = await Promise.all([api.mesh(false), api.mesh(true)]);
  try {
    const made = new View3D(find('view'), model, fine, coarse);
    find('view').append(legend());
    return made;
  } catch (error) {
    // everything else works without it
    const text = find('no-view');
    setText(text, `No 3D view: this browser has no WebGL (${(error as Error).message}).`);
    text.hidden = false;
    return null;
  }
}

async function start(): Promise<void> {
  try {
    const model = await api.model();
    const app = new App(model, await view(model));
    (window as unknown as { monitor: App }).monitor = app;
    document.body.classList.add('ready');
  } catch (error) {
    const banner = find('banner');
    setText(banner, `The page could not start: ${(error as Error).message}. Trying again …`);
    banner.hidden = false;
    setTimeout(() => void start(), 3000);
  }
}

void start();
