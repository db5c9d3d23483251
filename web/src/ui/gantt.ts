// The Gantt chart under the hall: time from left to right, zoom and pan, and what was clicked.

import type { DecisionEvent } from '../log/events';
import type { MachineInterval } from '../run/machines';
import { TaskColours } from '../run/names';
import type { Run } from '../run/run';
import { el } from './dom';
import { AXIS_PX, drawGrid, drawHead, drawRow, HEAD_PX, MARKS_PX, xOf, type Frame } from './gantt_draw';
import { ganttRows, type Row } from './gantt_rows';
import type { Theme } from './theme';

export type Picked =
  | { kind: 'time' }
  | { kind: 'decision'; decision: DecisionEvent }
  | { kind: 'task'; worker: string; n: number }
  | { kind: 'worker'; worker: string }
  | { kind: 'machine'; machine: string; interval: MachineInterval | undefined };

export interface GanttEvents {
  seek: (time: number) => void;
  pick: (what: Picked, time: number) => void;
  zoomed: () => void; // the part of time shown has changed
}

export class Gantt {
  readonly element: HTMLElement;
  selectedTask = 0;
  selectedName: string | undefined;
  private readonly canvas = el('canvas');
  private readonly spacer = el('div', { class: 'spacer' });
  private readonly scroller: HTMLElement;
  private readonly playhead = el('div', { class: 'playhead' });
  private readonly colours: TaskColours;
  private rows: Row[] = [];
  private rowsOf = -1;
  private window: [number, number] | undefined; // ticks shown; none: all
  private length = 1;
  private drag: { x: number; window: [number, number]; seeks: boolean; moved: boolean } | undefined;

  constructor(
    readonly run: Run,
    private theme: Theme,
    private readonly events: GanttEvents,
  ) {
    this.colours = new TaskColours(run.header);
    this.scroller = el('div', { class: 'scroller' }, this.canvas, this.spacer);
    this.element = el(
      'div',
      { class: 'gantt', role: 'img', label: 'Gantt chart: who does what, when' },
      this.scroller,
      this.playhead,
    );
    this.scroller.addEventListener('scroll', () => this.draw());
    this.canvas.addEventListener('pointerdown', (event) => this.press(event));
    this.canvas.addEventListener('pointermove', (event) => this.move(event));
    this.canvas.addEventListener('pointerup', (event) => this.lift(event));
    this.canvas.addEventListener('pointercancel', () => (this.drag = undefined));
    this.canvas.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
  }

  /** How many ticks the whole chart has: the longer of two runs that are compared. */
  setLength(length: number): void {
    this.length = Math.max(1, length);
  }

  get shown(): [number, number] {
    return this.window ?? [0, this.length];
  }

  show(window: [number, number] | undefined): void {
    this.window = window;
  }

  zoom(factor: number, around?: number): void {
    const [from, to] = this.shown;
    const fixed = around ?? (from + to) / 2;
    const width = Math.min(this.length, Math.max(10, (to - from) * factor));
    const start = Math.max(0, Math.min(this.length - width, fixed - ((fixed - from) / (to - from)) * width));
    this.window = width >= this.length ? undefined : [start, start + width];
    this.events.zoomed();
  }

  draw(): void {
    const frame = this.frame();
    if (!frame) return;
    const { context, theme, width, height } = frame;
    this.layRows();
    context.fillStyle = theme.paper;
    context.fillRect(0, 0, width, height);
    context.textBaseline = 'middle';
    drawGrid(frame);
    const scrolled = this.scroller.scrollTop;
    for (const row of this.rows) {
      const y = HEAD_PX + row.y - scrolled;
      if (y + row.height > HEAD_PX && y < height) drawRow(frame, row, y);
    }
    const end = this.run.end ? xOf(frame, this.run.last) : undefined;
    if (end !== undefined && end <= width) {
      context.fillStyle = this.run.end!.status === 'finished' ? theme.ink : theme.closed;
      context.fillRect(end, HEAD_PX, 1.5, height);
    }
    drawHead(frame);
  }

  movePlayhead(time: number): void {
    const frame = this.measure();
    const x = xOf(frame as Frame, Math.min(time, this.length));
    const visible = x >= frame.left - 1 && x <= frame.width;
    this.playhead.style.display = visible ? 'block' : 'none';
    this.playhead.style.transform = `translateX(${x - 1}px)`;
  }

  /** Where a tick is on the screen, for tests. */
  pointOf(name: string, t: number): { x: number; y: number } | undefined {
    this.layRows();
    const row = this.rows.find((candidate) => candidate.name === name && candidate.kind !== 'heading');
    const frame = this.measure();
    const box = this.canvas.getBoundingClientRect();
    const x = box.left + xOf(frame as Frame, t);
    if (name === 'decisions') return { x, y: box.top + HEAD_PX - 9 };
    if (row) this.reveal(row);
    return row ? { x, y: box.top + HEAD_PX + row.y + row.height / 2 - this.scroller.scrollTop } : undefined;
  }

  private reveal(row: Row): void {
    const view = this.scroller.clientHeight - HEAD_PX;
    const { scrollTop } = this.scroller;
    if (row.y < scrollTop || row.y + row.height > scrollTop + view) this.scroller.scrollTop = row.y - view / 2;
  }

  private layRows(): void {
    if (this.rowsOf === this.run.version) return;
    this.rowsOf = this.run.version;
    const { rows, height } = ganttRows(this.run);
    this.rows = rows;
    this.spacer.style.height = `${height + HEAD_PX - this.scroller.clientHeight}px`;
  }

  private measure(): Omit<Frame, 'context'> {
    const { clientWidth: width, clientHeight: height } = this.scroller;
    const [from, to] = this.shown;
    const { run, theme, colours, selectedTask, selectedName } = this;
    return { run, theme, colours, left: width < 560 ? 84 : 150, width, height, from, to, selectedTask, selectedName };
  }

  private frame(): Frame | undefined {
    const measures = this.measure();
    const context = this.canvas.getContext('2d');
    const ratio = Math.min(2, window.devicePixelRatio);
    const { width, height } = measures;
    if (!context || width === 0 || height === 0) return undefined;
    if (this.canvas.width !== Math.round(width * ratio) || this.canvas.height !== Math.round(height * ratio)) {
      this.canvas.width = Math.round(width * ratio);
      this.canvas.height = Math.round(height * ratio);
      this.canvas.style.width = `${width}px`;
      this.canvas.style.height = `${height}px`;
      this.rowsOf = -1;
      this.layRows();
    }
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    return { context, ...measures };
  }

  private timeAt(x: number): number {
    const { left, width, from, to } = this.measure();
    const share = (x - left) / Math.max(1, width - left - 8);
    return Math.min(this.length, Math.max(0, from + share * (to - from)));
  }

  private press(event: PointerEvent): void {
    const seeks = event.offsetY < AXIS_PX + MARKS_PX;
    this.drag = { x: event.offsetX, window: this.shown, seeks, moved: false };
    this.canvas.setPointerCapture(event.pointerId);
    if (seeks) this.events.seek(this.timeAt(event.offsetX));
  }

  private move(event: PointerEvent): void {
    const { drag } = this;
    if (!drag) return;
    if (Math.abs(event.offsetX - drag.x) > 4) drag.moved = true;
    if (!drag.moved) return;
    if (drag.seeks || !this.window) return this.events.seek(this.timeAt(event.offsetX));
    const [from, to] = drag.window;
    const { left, width } = this.measure();
    const by = ((drag.x - event.offsetX) / Math.max(1, width - left - 8)) * (to - from);
    const start = Math.max(0, Math.min(this.length - (to - from), from + by));
    this.window = [start, start + to - from];
    this.events.zoomed();
  }

  private lift(event: PointerEvent): void {
    const { drag } = this;
    this.drag = undefined;
    if (drag && !drag.moved) this.events.pick(this.hit(event.offsetX, event.offsetY), this.timeAt(event.offsetX));
  }

  private wheel(event: WheelEvent): void {
    if (!event.ctrlKey && !event.metaKey && !event.shiftKey) return; // scrolls the rows
    event.preventDefault();
    this.zoom(Math.exp((event.deltaY || event.deltaX) * 0.0025), this.timeAt(event.offsetX));
  }

  private hit(x: number, y: number): Picked {
    if (y < HEAD_PX) return y >= AXIS_PX + MARKS_PX ? this.hitDecision(x) : { kind: 'time' };
    const at = y - HEAD_PX + this.scroller.scrollTop;
    const row = this.rows.find((candidate) => at >= candidate.y && at < candidate.y + candidate.height);
    const { left } = this.measure();
    const time = this.timeAt(x);
    if (row?.kind === 'worker') {
      const bindings = this.run.diaries.get(row.name)?.bindings ?? [];
      const binding = x < left ? undefined : bindings.find((b) => b.since <= time && time < b.until);
      return binding ? { kind: 'task', worker: row.name, n: binding.n } : { kind: 'worker', worker: row.name };
    }
    if (row?.kind === 'machine') {
      return {
        kind: 'machine',
        machine: row.name,
        interval: x < left ? undefined : this.run.machines.at(row.name, time),
      };
    }
    return { kind: 'time' };
  }

  private hitDecision(x: number): Picked {
    const frame = this.measure() as Frame;
    let found: DecisionEvent | undefined;
    let best = 9; // pixels
    for (const decision of this.run.decisions) {
      const far = Math.abs(xOf(frame, decision.t) - x);
      if (far < best) [best, found] = [far, decision];
    }
    return found ? { kind: 'decision', decision: found } : { kind: 'time' };
  }
}
