// Draws the parts of the Gantt chart on a canvas.

import type { Run } from '../run/run';
import { milestoneMarks, shown, TaskColours } from '../run/names';
import { firstWhere, type StepSeries } from '../run/series';
import { pickFrom, inkOn, type Theme } from './theme';
import type { Row } from './gantt_rows';

export const AXIS_PX = 20; // tick numbers
export const MARKS_PX = 17; // milestones
export const DECISIONS_PX = 15;
export const HEAD_PX = AXIS_PX + MARKS_PX + DECISIONS_PX;

export interface Frame {
  context: CanvasRenderingContext2D;
  run: Run;
  theme: Theme;
  colours: TaskColours;
  left: number; // where time begins
  width: number;
  height: number;
  from: number; // ticks shown
  to: number;
  selectedTask: number; // decision, 0: none
  selectedName: string | undefined;
}

export const xOf = (frame: Frame, t: number): number =>
  frame.left + ((t - frame.from) / (frame.to - frame.from)) * (frame.width - frame.left - 8);

const FONT = 'system-ui, -apple-system, "Segoe UI", Roboto, Arial, sans-serif';
export const font = (size: number, weight = 400): string => `${weight} ${size}px ${FONT}`;

export function drawHead(frame: Frame): void {
  const { context, theme, left, width } = frame;
  context.fillStyle = theme.paper;
  context.fillRect(0, 0, width, HEAD_PX);
  const step = niceStep(((frame.to - frame.from) * 70) / Math.max(1, width - left));
  context.font = font(11);
  context.textAlign = 'center';
  for (let t = Math.ceil(frame.from / step) * step; t <= frame.to; t += step) {
    const x = xOf(frame, t);
    context.fillStyle = theme.muted;
    if (x < width - 14) context.fillText(String(t), x, AXIS_PX / 2 + 1);
  }
  names(frame);
  drawMarks(frame);
  drawDecisions(frame);
  context.fillStyle = theme.axis;
  context.fillRect(0, HEAD_PX - 1, width, 1);
}

function names({ context, theme }: Frame): void {
  context.textAlign = 'left';
  context.fillStyle = theme.muted;
  context.fillText('tick', 8, AXIS_PX / 2 + 1);
  context.fillText('milestones', 8, AXIS_PX + MARKS_PX / 2);
  context.fillText('decisions', 8, AXIS_PX + MARKS_PX + DECISIONS_PX / 2 - 1);
}

export function drawGrid(frame: Frame): void {
  const { context, theme, left, width, height } = frame;
  const step = niceStep(((frame.to - frame.from) * 70) / Math.max(1, width - left));
  context.fillStyle = theme.line;
  for (let t = Math.ceil(frame.from / step) * step; t <= frame.to; t += step)
    context.fillRect(xOf(frame, t), HEAD_PX, 1, height);
}

/** A letter where it fits beside the one before; a stroke for the others. */
function drawMarks(frame: Frame): void {
  const { context, theme, run, left } = frame;
  const marks = milestoneMarks(run.milestones.map((milestone) => milestone.name));
  context.font = font(11, 600);
  context.textAlign = 'center';
  let free = left;
  for (const { t, name } of run.milestones) {
    if (t < frame.from || t > frame.to) continue;
    let x = xOf(frame, t);
    context.fillStyle = theme.axis;
    context.fillRect(x, AXIS_PX + MARKS_PX - 5, 1, 5);
    const text = `(${marks.get(name)!})`;
    const half = context.measureText(text).width / 2 + 1;
    x = Math.min(x, frame.width - half - 3);
    if (x - half < free) continue;
    context.fillStyle = theme.ink;
    context.fillText(text, x, AXIS_PX + 6);
    free = x + half;
  }
}

function drawDecisions(frame: Frame): void {
  const { context, theme, run, colours } = frame;
  const y = AXIS_PX + MARKS_PX + DECISIONS_PX / 2 - 1;
  for (const { t, n, task } of run.decisions) {
    if (t < frame.from || t > frame.to) continue;
    const x = xOf(frame, t);
    const size = n === frame.selectedTask ? 7 : 4.5;
    context.beginPath();
    context.moveTo(x, y - size);
    context.lineTo(x + size, y);
    context.lineTo(x, y + size);
    context.lineTo(x - size, y);
    context.closePath();
    context.fillStyle = pickFrom(theme.tasks, colours.of(task).colour);
    context.fill();
    context.strokeStyle = theme.ink;
    context.lineWidth = n === frame.selectedTask ? 2 : 0.8;
    context.stroke();
  }
}

export function drawRow(frame: Frame, row: Row, y: number): void {
  const { context, theme, left, width } = frame;
  if (row.kind === 'heading') {
    context.fillStyle = theme.stripe;
    context.fillRect(0, y, width, row.height);
  }
  context.save();
  context.beginPath();
  context.rect(left, y, width - left, row.height);
  context.clip();
  if (row.kind === 'worker') drawWorker(frame, row, y);
  else if (row.kind === 'machine') drawMachine(frame, row, y);
  else if (row.kind !== 'heading') drawLevel(frame, row, y);
  context.restore();
  const strong = row.name === frame.selectedName;
  context.fillStyle = row.kind === 'heading' ? theme.muted : theme.ink;
  context.font = font(row.kind === 'machine' ? 10.5 : 11.5, strong || row.kind === 'heading' ? 700 : 400);
  context.textAlign = 'left';
  context.fillText(fitted(context, row.text, left - 14), 8, y + row.height / 2 + 0.5);
}

function drawWorker(frame: Frame, row: Row, y: number): void {
  const { run, context, theme, colours } = frame;
  const [top, tall] = [y + 2.5, row.height - 5];
  const all = run.activities(row.name);
  for (
    let i = firstWhere(all.length, (k) => all[k]!.end > frame.from);
    i < all.length && all[i]!.begin < frame.to;
    ++i
  ) {
    const { begin, end, kind, n } = all[i]!;
    const [x, wide] = [xOf(frame, begin), Math.max(0.6, xOf(frame, end) - xOf(frame, begin))];
    const task = run.tasks.get(n)?.decision.task;
    const colour = task === undefined ? theme.axis : pickFrom(theme.tasks, colours.of(task).colour);
    context.fillStyle = colour;
    context.globalAlpha = kind === 'work' ? 1 : kind === 'walk' ? 0.55 : kind === 'rest' ? 0.35 : 0.18;
    if (kind === 'walk' || kind === 'rest') context.fillRect(x, top + tall * 0.25, wide, tall * 0.5);
    else context.fillRect(x, top, wide, tall);
  }
  context.globalAlpha = 1;
  for (const { n, since, until } of run.diaries.get(row.name)!.bindings) {
    const end = Math.min(until, run.last);
    if (end < frame.from || since > frame.to) continue;
    const task = run.tasks.get(n)!.decision.task;
    const box = { x: xOf(frame, since), y: top, width: xOf(frame, end) - xOf(frame, since), height: tall };
    const { colour, variant } = colours.of(task);
    outline(frame, box, pickFrom(theme.tasks, colour), variant, n === frame.selectedTask);
    caption(frame, visible(frame, box), shown(task), theme.ink);
  }
}

interface Bar {
  x: number;
  y: number;
  width: number;
  height: number;
}

/** The part of a bar that is in the picture. */
function visible({ left, width }: Frame, bar: Bar): Bar {
  const from = Math.max(left, bar.x);
  return { ...bar, x: from, width: Math.min(width, bar.x + bar.width) - from };
}

/** The frame of a task; variants of a task differ in their lower edge: one line, two, three. */
function outline(
  { context, theme }: Frame,
  { x, y, width, height }: Bar,
  colour: string,
  variant: number,
  selected: boolean,
): void {
  context.strokeStyle = selected ? theme.ink : colour;
  context.lineWidth = selected ? 2.2 : 1;
  context.strokeRect(x + 0.5, y, Math.max(1, width - 1), height);
  context.fillStyle = theme.ink;
  for (let i = 0; i < Math.min(3, variant); ++i)
    context.fillRect(x + 2, y + height - 1.5 - i * 3, Math.max(0, width - 4), 1.2);
}

function caption({ context, theme }: Frame, { x, y, width, height }: Bar, text: string, ink: string): void {
  context.font = font(10.5, 500);
  if (width < context.measureText(text).width + 8) return;
  context.textAlign = 'center';
  context.lineWidth = 3;
  context.lineJoin = 'round';
  context.strokeStyle = theme.paper;
  context.globalAlpha = 0.75;
  context.strokeText(text, x + width / 2, y + height / 2 + 0.5);
  context.globalAlpha = 1;
  context.fillStyle = ink;
  context.fillText(text, x + width / 2, y + height / 2 + 0.5);
}

function drawMachine(frame: Frame, row: Row, y: number): void {
  const { run, context, theme, colours } = frame;
  const all = run.machines.intervals.get(row.name) ?? [];
  const [top, tall] = [y + 1.5, row.height - 3];
  for (
    let i = firstWhere(all.length, (k) => all[k]!.end > frame.from);
    i < all.length && all[i]!.begin < frame.to;
    ++i
  ) {
    const { begin, end, state, n, operation } = all[i]!;
    const [x, wide] = [xOf(frame, begin), Math.max(0.8, xOf(frame, Math.min(end, run.last)) - xOf(frame, begin))];
    const task = n > 0 ? run.tasks.get(n)?.decision.task : undefined;
    const colour = task ? pickFrom(theme.tasks, colours.of(task).colour) : theme[state];
    context.fillStyle = colour;
    context.globalAlpha = state === 'working' ? 0.85 : 0.4;
    if (state === 'held') context.fillRect(x, top + tall * 0.3, wide, tall * 0.4);
    else context.fillRect(x, top, wide, tall);
    context.globalAlpha = 1;
    context.font = font(9.5);
    const text = shown(operation);
    if (state !== 'working' || wide < context.measureText(text).width + 6) continue;
    context.fillStyle = inkOn(colour);
    context.textAlign = 'center';
    context.fillText(text, x + wide / 2, y + row.height / 2 + 0.5);
  }
}

function drawLevel(frame: Frame, row: Row, y: number): void {
  const { run, context, theme } = frame;
  const series = run.material.counts.get(row.name);
  if (!series || row.most <= 0) return;
  const [floor, tall] = [y + row.height - 2, row.height - 5];
  const materials = [...run.materials];
  const colour = row.material ? pickFrom(theme.materials, Math.max(0, materials.indexOf(row.material))) : theme.working;
  const end = xOf(frame, Math.min(frame.to, run.last));
  context.beginPath();
  context.moveTo(xOf(frame, frame.from), floor);
  let height = (series.at(frame.from) / row.most) * tall;
  context.lineTo(xOf(frame, frame.from), floor - height);
  for (const [t, value] of changes(series, frame.from, Math.min(frame.to, run.last))) {
    context.lineTo(xOf(frame, t), floor - height);
    height = (value / row.most) * tall;
    context.lineTo(xOf(frame, t), floor - height);
  }
  context.lineTo(end, floor - height);
  context.strokeStyle = colour;
  context.lineWidth = 1.4;
  context.stroke();
  context.lineTo(end, floor);
  context.fillStyle = colour;
  context.globalAlpha = 0.22;
  context.fill();
  context.globalAlpha = 1;
  context.fillStyle = theme.line;
  context.fillRect(frame.left, floor, frame.width, 1);
}

function* changes(series: StepSeries, from: number, to: number): Generator<[number, number]> {
  const { ticks, values } = series;
  for (let i = firstWhere(ticks.length, (k) => ticks[k]! > from); i < ticks.length && ticks[i]! <= to; ++i)
    yield [ticks[i]!, values[i]!];
}

function fitted(context: CanvasRenderingContext2D, text: string, width: number): string {
  if (context.measureText(text).width <= width) return text;
  let short = text;
  while (short.length > 1 && context.measureText(`${short}…`).width > width) short = short.slice(0, -1);
  return `${short}…`;
}

/** The smallest of 1, 2, 5, 10, 20, … that is not below `least`. */
export function niceStep(least: number): number {
  const power = 10 ** Math.floor(Math.log10(Math.max(1, least)));
  for (const factor of [1, 2, 5, 10]) if (factor * power >= least) return factor * power;
  return 10 * power;
}
