// node build.mjs FOLDER: checks the types, then bundles the page into FOLDER.
import { spawnSync } from 'node:child_process';
import { copyFileSync, mkdirSync, renameSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { build } from 'esbuild';

const target = process.argv[2];
const part = `${target}.part`;
const checked = spawnSync(process.execPath, ['node_modules/typescript/bin/tsc', '-p', '.'], { stdio: 'inherit' });
if (checked.status !== 0) process.exit(1);

rmSync(part, { recursive: true, force: true });
mkdirSync(join(part, 'assets'), { recursive: true });
await build({
  entryPoints: { monitor: 'src/main.ts' },
  outdir: join(part, 'assets'),
  bundle: true,
  minify: true,
  format: 'esm',
  target: 'es2022',
  legalComments: 'linked',
  logLevel: 'warning',
});
copyFileSync('src/index.html', join(part, 'index.html'));
rmSync(target, { recursive: true, force: true });
renameSync(part, target);
