// What the server holds still: the model, the runs.
import { unpack, type Block, type Model, type RunEntry } from './protocol';

async function get(path: string): Promise<Response> {
  const answer = await fetch(path);
  if (answer.ok) return answer;
  let reason = `${answer.status} ${answer.statusText}`;
  try {
    const told = await answer.json();
    reason = [told.error, told.hint].filter(Boolean).join('; ');
  } catch {
    // not one of the server's own errors
  }
  throw new Error(reason);
}

export async function model(): Promise<Model> {
  return (await get('/api/model')).json();
}

export async function mesh(coarse: boolean): Promise<Block> {
  return unpack(await (await get(`/api/mesh?coarse=${coarse ? 1 : 0}`)).arrayBuffer());
}

export async function runs(): Promise<{ root: string; runs: RunEntry[] }> {
  return (await get('/api/runs')).json();
}

function path(id: string): string {
  return '/api/runs/' + id.split('/').map(encodeURIComponent).join('/');
}

export async function track(id: string): Promise<Block> {
  return unpack(await (await get(`${path(id)}/track`)).arrayBuffer());
}

export async function soil(id: string): Promise<Block> {
  return unpack(await (await get(`${path(id)}/soil`)).arrayBuffer());
}

export function file(id: string, name: string): string {
  return `${path(id)}/file/${name}`;
}
