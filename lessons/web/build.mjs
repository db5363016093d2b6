// Bundles the program of the lesson pages into dist/, which is checked in.
import { build } from 'esbuild';

await build({
  entryPoints: { player: 'src/main.ts' },
  outdir: process.argv[2] ?? 'dist',
  bundle: true,
  minify: true,
  format: 'iife',
  target: 'es2020',
  legalComments: 'none',
  banner: {
    js: '/* merge2d lesson player, MIT. Contains fflate, MIT, (c) Arjun Barrett. Made from lessons/web/src by lessons/web/build.mjs. */',
  },
  logLevel: 'warning',
});
await build({
  entryPoints: { player: 'src/style.css' },
  outdir: process.argv[2] ?? 'dist',
  minify: true,
  target: 'es2020',
  logLevel: 'warning',
});
