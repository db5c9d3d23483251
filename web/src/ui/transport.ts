// Play, pause, speed, the slider of time, and the jumps.

import { SPEEDS, type Clock } from './clock';
import { button, el } from './dom';

export interface TransportEvents {
  toggle: () => void;
  seek: (time: number) => void;
  redraw: () => void;
  jump: (what: 'decision' | 'event', direction: 1 | -1) => void;
  follow: () => void;
  zoom: (factor: number) => void;
}

export class Transport {
  readonly element: HTMLElement;
  private readonly play: HTMLButtonElement;
  private readonly slider = el('input', {
    type: 'range',
    label: 'time',
    title: 'Time: drag to any tick',
    class: 'slider',
  });
  private readonly readout = el('output', { class: 'readout', label: 'tick' });
  private readonly speed = el('select', { label: 'speed', title: 'Speed, times real time' });
  private readonly live: HTMLButtonElement;

  constructor(
    private readonly clock: Clock,
    events: TransportEvents,
  ) {
    this.play = button('▶', 'Play or pause (space)', events.toggle, 'play');
    this.live = button('● live', 'Follow the running simulation (end)', events.follow, 'live');
    for (const speed of SPEEDS) this.speed.append(new Option(`${speed}×`, String(speed)));
    this.speed.addEventListener('change', () => {
      clock.speed = Number(this.speed.value);
      events.redraw();
    });
    this.slider.step = 'any';
    this.slider.addEventListener('input', () => events.seek(Number(this.slider.value)));
    this.element = el(
      'div',
      { class: 'transport' },
      button('«', 'Previous decision (shift + ←)', () => events.jump('decision', -1)),
      button('‹', 'Previous event (←)', () => events.jump('event', -1)),
      this.play,
      button('›', 'Next event (→)', () => events.jump('event', 1)),
      button('»', 'Next decision (shift + →)', () => events.jump('decision', 1)),
      this.speed,
      this.slider,
      this.readout,
      this.live,
      button('−', 'Gantt chart: show more time (−)', () => events.zoom(1.6), 'zoom'),
      button('+', 'Gantt chart: show less time (+)', () => events.zoom(1 / 1.6), 'zoom'),
    );
  }

  draw(live: boolean): void {
    const { clock } = this;
    set(this.play, clock.playing ? '❚❚' : '▶');
    this.slider.max = String(Math.max(1, clock.last));
    this.slider.value = String(clock.time);
    this.speed.value = String(clock.speed);
    set(this.readout, `${Math.floor(clock.time)} / ${clock.last}`);
    this.live.hidden = !live;
    this.live.classList.toggle('on', clock.following);
  }
}

function set(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}
