// The keyboard, and the list of what its keys do.

import { button, el } from './dom';

export interface Command {
  keys: string[]; // KeyboardEvent.key, with "shift+" where it matters
  shown: string;
  text: string;
  run: () => void;
}

export function listen(commands: Command[]): void {
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const target = event.target as HTMLElement;
    const typing =
      target instanceof HTMLSelectElement || (target instanceof HTMLInputElement && target.type !== 'range');
    if (typing && event.key !== 'Escape') return;
    if (document.querySelector('dialog[open]') && !['Escape', '?', 'h'].includes(event.key)) return;
    const key = `${event.shiftKey && event.key.length > 1 ? 'shift+' : ''}${event.key}`;
    const command = commands.find(({ keys }) => keys.includes(key));
    if (!command) return;
    event.preventDefault();
    command.run();
  });
}

export function helpDialog(commands: Command[]): HTMLDialogElement {
  const rows = commands.map(({ shown, text }) => el('tr', {}, el('th', {}, el('kbd', {}, shown)), el('td', {}, text)));
  const mouse: [string, string][] = [
    ['drag', 'turn the hall; with the right button or two fingers: move it; wheel or pinch: zoom'],
    ['click', 'an agent, a machine, a bar or a decision (diamond): what it is and why'],
    ['drag in the chart', 'on the ticks: move through time; zoomed in: move the chart; ctrl + wheel: zoom'],
  ];
  const more = mouse.map(([what, text]) => el('tr', {}, el('th', {}, what), el('td', {}, text)));
  const dialog = el(
    'dialog',
    { class: 'help' },
    el('h3', {}, 'Keys and mouse'),
    el('table', { class: 'plain' }, el('tbody', {}, ...rows, ...more)),
    button('Close', 'Close (escape)', () => dialog.close()),
  );
  return dialog;
}
