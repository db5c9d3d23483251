import './style.css';
import { App } from './ui/app';
import { embeddedSources, servedSources } from './ui/sources';

const app = new App(document.getElementById('app')!);

async function start(): Promise<void> {
  const embedded = embeddedSources();
  if (embedded) return app.add(embedded);
  if (location.protocol === 'http:' || location.protocol === 'https:') return app.add(await servedSources());
  app.invite(
    'Choose files here or drop them anywhere on this page. linewright simulate … --log FILE.jsonl writes them.',
  );
}

// For tests and benchmarks; docs/view.md describes it.
Object.assign(window, {
  linewright: {
    state: () => app.state(),
    seek: (time: number) => app.seek(time),
    meter: () => app.meter.read(),
    shownAfterMs: () => app.shownAfterMs,
    pointOf: (run: number, name: string, t: number) => app.panes[run]?.gantt.pointOf(name, t),
  },
});

start().catch((error: unknown) => {
  const why = error instanceof Error ? error.message : 'unknown error';
  app.fail(`The logs could not be loaded: ${why}. Is linewright view still running?`);
  app.invite('Or choose files here, or drop them anywhere on this page.');
});
