// Reads an event log piece by piece, as it comes from a file, the page itself or a running simulation.

import { EventChecker, type LogEvent } from './events';
import { isObject, readHeader, type Header, type Tick } from './header';

export interface Problem {
  severity: 'error' | 'warning'; // error: nothing of this log can be shown
  text: string;
}

export interface Limits {
  characters: number;
  events: number;
}

/** What a browser's page carries without becoming slow: some hundred orders, an hour of a big hall. */
export const LIMITS: Limits = { characters: 64e6, events: 600_000 };

const FORMAT = 'linewright/event_log/';
const VERSION = '1';
const MOST_FAULTS = 3; // of single lines, that are described
const LONGEST_LINE = 8e6;

export class LogReader {
  header: Header | undefined;
  readonly problems: Problem[] = [];
  done = false; // nothing further is read: `end`, an error, or a limit
  characters = 0;

  private rest = '';
  private lines = 0;
  private events = 0;
  private faults = 0;
  private last: Tick = 0;
  private ended = false;
  private checker: EventChecker | undefined;

  constructor(private readonly limits: Limits = LIMITS) {}

  /** Reads the next piece; returns the events that it completed. */
  push(piece: string): LogEvent[] {
    const events: LogEvent[] = [];
    if (this.done) return events;
    this.characters += piece.length;
    const lines = (this.rest + piece).split('\n');
    this.rest = lines.pop() ?? '';
    for (const line of lines) {
      if (this.done) break;
      this.line(line, events);
    }
    if (this.rest.length > LONGEST_LINE) this.refuse('This is not an event log: it has no lines.');
    if (!this.done && this.characters > this.limits.characters) this.tooLarge();
    return events;
  }

  /** The input is over. Returns the event of a last line without a line break. */
  finish(): LogEvent[] {
    const events: LogEvent[] = [];
    const rest = this.rest;
    this.rest = '';
    if (!this.done && rest.trim() !== '') {
      if (this.header && !isJson(rest)) this.cutOff('in the middle of a line');
      else this.line(rest, events);
    }
    if (!this.header && !this.problems.length) this.refuse('The file is empty: there is no log in it.');
    if (!this.done) this.cutOff(`after tick ${this.last}`);
    this.describeFaults();
    return events;
  }

  private line(line: string, events: LogEvent[]): void {
    this.lines += 1;
    if (line.trim() === '') return;
    const value = parsed(line);
    if (!this.header) return this.first(value);
    const fault = isObject(value) ? this.checker!.fault(value) : 'it is not a JSON object';
    if (fault) return this.fault(fault);
    const event = value as unknown as LogEvent;
    if (event.t < this.last) return this.fault('time runs backwards');
    this.last = event.t;
    this.events += 1;
    events.push(event);
    if (event.event === 'end') this.done = this.ended = true;
    else if (this.events >= this.limits.events) this.tooLarge();
  }

  private first(value: unknown): void {
    const format = isObject(value) ? value.format : undefined;
    if (typeof format !== 'string' || !format.startsWith(FORMAT)) {
      return this.refuse(
        'This is not an event log: its first line is not a header with "format": "linewright/event_log/1". ' +
          'Logs are written by linewright simulate … --log FILE.jsonl.',
      );
    }
    const version = format.slice(FORMAT.length);
    if (version !== VERSION) {
      return this.refuse(
        `This log has version ${version.slice(0, 20)} of the format; this page reads version ${VERSION}. ` +
          'Open it with the linewright that wrote it, or write it again.',
      );
    }
    this.header = readHeader(value as Record<string, unknown>);
    this.checker = new EventChecker(this.header);
  }

  private fault(text: string): void {
    this.faults += 1;
    if (this.faults <= MOST_FAULTS) this.warn(`Line ${this.lines} is left out: ${text}.`);
  }

  private describeFaults(): void {
    const more = this.faults - MOST_FAULTS;
    if (more > 0) this.warn(`${more} further line${more === 1 ? ' is' : 's are'} left out, too.`);
  }

  private cutOff(where: string): void {
    if (this.ended) return;
    this.done = true;
    this.warn(`The log is cut off ${where}: the run is shown up to tick ${this.last}.`);
  }

  private tooLarge(): void {
    this.done = true;
    if (!this.header) return this.refuse('The file is too large, and no event log.');
    const size = Math.round(this.characters / 1e6);
    this.warn(
      `The log is too large for a page (more than ${size} MB or ${this.events} events read): ` +
        `the run is shown up to tick ${this.last}.`,
    );
  }

  private refuse(text: string): void {
    this.done = true;
    this.problems.push({ severity: 'error', text });
  }

  private warn(text: string): void {
    this.problems.push({ severity: 'warning', text });
  }
}

function parsed(line: string): unknown {
  try {
    return JSON.parse(line);
  } catch {
    return undefined;
  }
}

function isJson(line: string): boolean {
  return parsed(line) !== undefined;
}
