// Where logs come from: the page itself, the server that serves it, or files that the user chooses.

import { LogReader, type Problem } from '../log/reader';
import { isObject } from '../log/header';
import { Run } from '../run/run';

/** A log that is being read, or has been. */
export interface LoadedLog {
  name: string;
  run: Run | undefined; // none: not yet, or nothing can be shown
  problems: Problem[];
  live: boolean; // the simulation still runs
  reading: boolean;
  characters: number;
}

export interface Source {
  name: string;
  live: boolean;
  pieces: () => AsyncIterable<string>;
}

const SLICE_MS = 25; // reading lets the page breathe after so long

export function newLog(source: Source): LoadedLog {
  return { name: source.name, run: undefined, problems: [], live: source.live, reading: true, characters: 0 };
}

/** Reads a source to its end; `changed` is called whenever there is more to show. */
export async function read(source: Source, log: LoadedLog, changed: () => void): Promise<void> {
  const reader = new LogReader();
  const take = (events: ReturnType<LogReader['push']>): void => {
    if (!log.run && reader.header) log.run = new Run(log.name, reader.header);
    for (const event of events) log.run!.add(event);
    log.characters = reader.characters;
    log.problems = [...reader.problems];
  };
  let since = performance.now();
  try {
    for await (const piece of source.pieces()) {
      take(reader.push(piece));
      if (log.live) changed();
      if (reader.done) break;
      if (performance.now() - since < SLICE_MS) continue;
      changed();
      await new Promise((resolve) => setTimeout(resolve));
      since = performance.now();
    }
    take(reader.finish());
  } catch (error) {
    take(reader.finish());
    const text = `${log.name} could not be read to its end: ${error instanceof Error ? error.message : 'unknown error'}.`;
    log.problems.unshift({ severity: log.run ? 'warning' : 'error', text });
  }
  log.reading = log.live = false;
  changed();
}

/** Logs that were written into the page, or nothing. */
export function embeddedSources(): Source[] | undefined {
  const text = document.getElementById('linewright-logs')?.textContent ?? 'null';
  const value: unknown = JSON.parse(text);
  if (!isObject(value) || !Array.isArray(value.logs)) return undefined;
  return value.logs.filter(isObject).map((entry, i) => ({
    name: typeof entry.name === 'string' ? entry.name : `log ${i + 1}`,
    live: false,
    pieces: () => slices(typeof entry.text === 'string' ? entry.text : ''),
  }));
}

/** The logs that the server has. */
export async function servedSources(): Promise<Source[]> {
  const answer = await fetch('logs.json', { cache: 'no-store' });
  if (!answer.ok) throw new Error(`the server answered ${answer.status} for its list of logs`);
  const value: unknown = await answer.json();
  if (!isObject(value) || !Array.isArray(value.logs)) throw new Error('the server’s list of logs is not as expected');
  return value.logs.filter(isObject).map((entry) => {
    const href = String(entry.href);
    return { name: String(entry.name), live: entry.live === true, pieces: () => served(href) };
  });
}

export function fileSource(file: File): Source {
  return { name: file.name, live: false, pieces: () => decoded(file.stream()) };
}

async function* served(href: string): AsyncIterable<string> {
  const answer = await fetch(href, { cache: 'no-store' });
  if (!answer.ok || !answer.body) throw new Error(`the server answered ${answer.status}`);
  yield* decoded(answer.body);
}

async function* decoded(stream: ReadableStream<Uint8Array>): AsyncIterable<string> {
  const decoder = new TextDecoder();
  const reader = stream.getReader();
  try {
    for (;;) {
      const { done, value } = await reader.read();
      if (done) break;
      yield decoder.decode(value, { stream: true });
    }
    yield decoder.decode();
  } finally {
    reader.cancel().catch(() => undefined); // whether it was read to its end or given up
  }
}

async function* slices(text: string): AsyncIterable<string> {
  const size = 1 << 19;
  for (let at = 0; at < text.length; at += size) yield text.slice(at, at + size);
}
