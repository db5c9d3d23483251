// Labels over the hall, drawn flat on a canvas of their own. Where two would overlap, the more important one stays.

import type { Theme } from '../ui/theme';
import { inkOn } from '../ui/theme';

export interface Label {
  text: string;
  x: number; // pixels
  y: number;
  rank: number; // lower is more important
  look: 'agent' | 'machine' | 'count' | 'place';
  colour?: string; // of the agent's task, the machine's state, the material
  share?: number; // 0 … 1: how far a machine's operation is
  strong?: boolean; // selected
}

interface Box {
  x0: number;
  x1: number;
  y0: number;
  y1: number;
}

const FONT = '-apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif';

export class Labels {
  private readonly context: CanvasRenderingContext2D | null;
  private readonly widths = new Map<string, number>();

  constructor(private readonly canvas: HTMLCanvasElement) {
    this.context = canvas.getContext('2d');
  }

  draw(labels: Label[], width: number, height: number, ratio: number, theme: Theme): void {
    const context = this.context;
    if (!context) return;
    if (this.canvas.width !== Math.round(width * ratio) || this.canvas.height !== Math.round(height * ratio)) {
      this.canvas.width = Math.round(width * ratio);
      this.canvas.height = Math.round(height * ratio);
    }
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    context.textBaseline = 'middle';
    const taken: Box[] = [];
    for (const label of [...labels].sort((a, b) => a.rank - b.rank)) {
      const box = this.box(context, label);
      if (box.x0 < 2 || box.x1 > width - 2 || box.y0 < 2 || box.y1 > height - 2) continue;
      if (taken.some((other) => overlap(box, other))) continue;
      taken.push(box);
      paint(context, label, box, theme);
    }
  }

  private box(context: CanvasRenderingContext2D, label: Label): Box {
    context.font = font(label);
    const key = `${context.font} ${label.text}`;
    let wide = this.widths.get(key);
    if (wide === undefined) {
      wide = context.measureText(label.text).width;
      if (this.widths.size > 5000) this.widths.clear();
      this.widths.set(key, wide);
    }
    const half = wide / 2 + (label.look === 'place' ? 2 : 6);
    const tall = label.look === 'place' ? 7 : 9;
    return { x0: label.x - half, x1: label.x + half, y0: label.y - tall, y1: label.y + tall };
  }
}

function font({ look, strong }: Label): string {
  if (look === 'place') return `11px ${FONT}`;
  return `${strong || look === 'agent' ? '600 ' : ''}11px ${FONT}`;
}

function overlap(a: Box, b: Box): boolean {
  return a.x0 < b.x1 + 1 && b.x0 < a.x1 + 1 && a.y0 < b.y1 + 1 && b.y0 < a.y1 + 1;
}

function paint(context: CanvasRenderingContext2D, label: Label, box: Box, theme: Theme): void {
  const { look, text, share, colour } = label;
  context.textAlign = 'center';
  if (look === 'place') {
    context.lineWidth = 3;
    context.lineJoin = 'round';
    context.strokeStyle = theme.floor;
    context.strokeText(text, label.x, label.y);
    context.fillStyle = theme.muted;
    context.fillText(text, label.x, label.y);
    return;
  }
  const filled = look === 'agent';
  const ground = filled && colour ? colour : theme.paper;
  context.globalAlpha = 0.94;
  context.fillStyle = ground;
  pill(context, box);
  context.fill();
  context.globalAlpha = 1;
  if (share !== undefined && colour) progress(context, box, share, colour);
  context.strokeStyle = label.strong ? theme.ink : (colour ?? theme.axis);
  context.lineWidth = label.strong ? 2 : 1.2;
  pill(context, box);
  context.stroke();
  context.fillStyle = filled && colour ? inkOn(ground) : theme.ink;
  context.fillText(text, label.x, label.y + 0.5);
}

function progress(context: CanvasRenderingContext2D, box: Box, share: number, colour: string): void {
  context.save();
  pill(context, box);
  context.clip();
  context.globalAlpha = 0.35;
  context.fillStyle = colour;
  context.fillRect(box.x0, box.y0, (box.x1 - box.x0) * share, box.y1 - box.y0);
  context.restore();
}

function pill(context: CanvasRenderingContext2D, { x0, x1, y0, y1 }: Box): void {
  context.beginPath();
  context.roundRect(x0, y0, x1 - x0, y1 - y0, 5);
}
