// What is wrong with the logs, in a strip under the bar; and the invitation to open some.

import { el } from './dom';
import type { LoadedLog } from './sources';

const READING_FROM = 2e6; // characters: smaller logs are there before one could read a message

export class Messages {
  private readonly list = el('div');
  private readonly invitation = el('div');
  readonly element = el('div', { class: 'messages', role: 'status' }, this.list, this.invitation);
  private drawn = '';
  private failed: string | undefined;

  draw(logs: LoadedLog[]): void {
    const entries: { severity: string; text: string }[] = [];
    if (this.failed !== undefined) entries.push({ severity: 'error', text: this.failed });
    for (const log of logs) {
      for (const { severity, text } of log.problems) entries.push({ severity, text: `${log.name}: ${text}` });
      if (log.reading && !log.live && log.characters > READING_FROM) {
        entries.push({ severity: 'note', text: `${log.name}: reading … ${Math.round(log.characters / 1e6)} MB` });
      }
    }
    if (logs.some((log) => log.run || log.reading)) this.invitation.replaceChildren();
    const key = JSON.stringify(entries);
    if (key === this.drawn) return;
    this.drawn = key;
    this.list.replaceChildren(...entries.map(({ severity, text }) => el('p', { class: severity }, text)));
  }

  fail(text: string): void {
    this.failed = text;
    this.draw([]);
  }

  invite(text: string, open: (files: FileList) => void): void {
    const file = el('input', { type: 'file', label: 'event logs' });
    file.multiple = true;
    file.addEventListener('change', () => {
      if (file.files?.length) open(file.files);
    });
    this.invitation.replaceChildren(
      el(
        'div',
        { class: 'invite' },
        el('h2', {}, 'Open an event log'),
        el('p', {}, text),
        file,
        el('p', { class: 'hint' }, 'Two logs are compared. Nothing leaves this computer.'),
      ),
    );
  }
}
