import type { App } from './app';
import type { Command } from './keys';

/** Everything that the keyboard does, in the order of the help list. */
export function commandsOf(app: App): Command[] {
  return [
    { keys: [' ', 'k'], shown: 'space', text: 'play or pause', run: () => app.toggle() },
    { keys: ['ArrowRight'], shown: '→', text: 'next event', run: () => app.jump('event', 1) },
    { keys: ['ArrowLeft'], shown: '←', text: 'previous event', run: () => app.jump('event', -1) },
    {
      keys: ['shift+ArrowRight', 'n'],
      shown: 'shift →',
      text: 'next decision, with its reasons',
      run: () => app.jump('decision', 1),
    },
    {
      keys: ['shift+ArrowLeft', 'p'],
      shown: 'shift ←',
      text: 'previous decision',
      run: () => app.jump('decision', -1),
    },
    { keys: ['Home'], shown: 'home', text: 'to the start', run: () => app.seek(0) },
    { keys: ['End'], shown: 'end', text: 'to the end; follow a running simulation', run: () => app.followEnd() },
    { keys: ['ArrowUp', '>'], shown: '↑', text: 'faster', run: () => faster(app, 1) },
    { keys: ['ArrowDown', '<'], shown: '↓', text: 'slower', run: () => faster(app, -1) },
    { keys: ['o'], shown: 'o', text: 'the whole hall', run: () => app.camera('overview') },
    { keys: ['t'], shown: 't', text: 'from above', run: () => app.camera('top') },
    { keys: ['f'], shown: 'f', text: 'follow the selected agent', run: () => app.camera('follow') },
    { keys: ['l'], shown: 'l', text: 'labels: all, agents only, none', run: () => app.cycleLabels() },
    { keys: ['r'], shown: 'r', text: 'routes that were gone', run: () => app.toggleRoutes() },
    { keys: ['d'], shown: 'd', text: 'light or dark', run: () => app.toggleTheme() },
    { keys: ['+', '='], shown: '+', text: 'Gantt chart: zoom in', run: () => app.zoom(1 / 1.6) },
    { keys: ['-'], shown: '−', text: 'Gantt chart: zoom out', run: () => app.zoom(1.6) },
    { keys: ['Escape'], shown: 'esc', text: 'close what is open', run: () => app.escape() },
    { keys: ['?', 'h'], shown: '?', text: 'this list', run: () => app.toggleHelp() },
  ];
}

function faster(app: App, steps: number): void {
  app.clock.faster(steps);
  app.redraw();
}
