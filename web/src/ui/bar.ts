// The bar at the top: which logs, how to look at them.

import { shown } from '../run/names';
import { button, el } from './dom';
import type { LoadedLog } from './sources';

export interface BarEvents {
  choose: (side: 0 | 1, index: number) => void;
  camera: (mode: 'overview' | 'top' | 'follow') => void;
  labels: () => void;
  routes: () => void;
  theme: () => void;
  help: () => void;
  open: (files: FileList) => void;
}

export class Bar {
  readonly element: HTMLElement;
  private readonly title = el('h1');
  private readonly choices = el('div', { class: 'choices' });
  private drawn = '';

  constructor(private readonly events: BarEvents) {
    const file = el('input', { type: 'file', label: 'logs', class: 'file' });
    file.multiple = true;
    file.accept = '.jsonl,.json,.log,.txt';
    file.addEventListener('change', () => {
      if (file.files?.length) events.open(file.files);
      file.value = '';
    });
    this.element = el(
      'header',
      { class: 'bar' },
      this.title,
      this.choices,
      el(
        'nav',
        {},
        button('Hall', 'The whole hall (o)', () => events.camera('overview')),
        button('Top', 'From above (t)', () => events.camera('top')),
        button('Follow', 'Follow the selected agent (f)', () => events.camera('follow')),
        button('Labels', 'Labels: all, agents only, none (l)', events.labels),
        button('Routes', 'Routes that were gone (r)', events.routes),
        button('Open', 'Open event logs', () => file.click()),
        button('◐', 'Light or dark (d)', events.theme),
        button('?', 'Keys and mouse (?)', events.help),
        file,
      ),
    );
  }

  draw(logs: LoadedLog[], selected: [number, number]): void {
    const key = JSON.stringify([logs.map((log) => [log.name, log.run !== undefined]), selected]);
    if (key === this.drawn) return;
    this.drawn = key;
    const line = logs[selected[0]]?.run?.header.line;
    this.title.textContent = line ? shown(line) : 'Linewright';
    document.title = line ? `${shown(line)} – Linewright` : 'Linewright';
    this.choices.replaceChildren();
    if (logs.length < 2) return;
    for (const side of [0, 1] as const) {
      const select = el('select', {
        label: side === 0 ? 'log A' : 'log B',
        title: side === 0 ? 'The log A' : 'The log B, for comparison',
      });
      if (side === 1) select.append(new Option('no comparison', '-1'));
      logs.forEach((log, i) => select.append(new Option(`${side === 0 ? 'A' : 'B'}: ${log.name}`, String(i))));
      select.value = String(selected[side]);
      select.addEventListener('change', () => this.events.choose(side, Number(select.value)));
      this.choices.append(select);
    }
  }
}
