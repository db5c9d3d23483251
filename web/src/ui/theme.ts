// Colours, light and dark. Task colours are those of `linewright gantt`: the first seven are Okabe and Ito's, the
// others were chosen for their distance from all before them for every kind of colour vision.

export type ThemeName = 'light' | 'dark';

export interface Theme {
  name: ThemeName;
  tasks: string[];
  kinds: string[]; // of workers: people, robots, others
  materials: string[];
  background: string;
  floor: string;
  grid: string;
  wall: string;
  block: string;
  glass: string;
  edge: string;
  carrier: string;
  machine: string;
  working: string;
  held: string;
  recovering: string;
  station: string;
  route: string;
  closed: string;
  ink: string;
  muted: string;
  paper: string;
  stripe: string;
  line: string;
  axis: string;
  wait: string;
}

const LIGHT: Theme = {
  name: 'light',
  tasks: [
    '#E69F00',
    '#56B4E9',
    '#009E73',
    '#CC79A7',
    '#0072B2',
    '#D55E00',
    '#F0E442',
    '#8F5BE8',
    '#6B2A0B',
    '#AACCAA',
    '#1B2F80',
    '#7A5C5C',
  ],
  kinds: ['#D55E00', '#0072B2', '#8F5BE8', '#6B2A0B'],
  materials: ['#E69F00', '#56B4E9', '#009E73', '#CC79A7', '#F0E442', '#8F5BE8', '#D55E00', '#1B2F80'],
  background: '#dfe5ea',
  floor: '#f3f5f7',
  grid: '#e1e6ea',
  wall: '#c3ccd4',
  block: '#cfd7de',
  glass: '#9fb2c4',
  edge: '#7d8c9a',
  carrier: '#5f7280',
  machine: '#aab6c1',
  working: '#009E73',
  held: '#E69F00',
  recovering: '#56B4E9',
  station: '#8fa0af',
  route: '#a9b7c4',
  closed: '#D55E00',
  ink: '#18212b',
  muted: '#5b6876',
  paper: '#ffffff',
  stripe: '#f6f8fa',
  line: '#e4e9ee',
  axis: '#b7c1cb',
  wait: '#dfe4e9',
};

const DARK: Theme = {
  name: 'dark',
  tasks: [
    '#E69F00',
    '#56B4E9',
    '#009E73',
    '#CC79A7',
    '#0B7FC4',
    '#D55E00',
    '#F0E442',
    '#A276F2',
    '#9A5230',
    '#B4D6B4',
    '#4659CC',
    '#8C7272',
  ],
  kinds: ['#F0742E', '#3A96DB', '#A276F2', '#B98A62'],
  materials: ['#E69F00', '#56B4E9', '#1FB58A', '#DD95BD', '#F0E442', '#A276F2', '#F0742E', '#6F80E8'],
  background: '#0c0f13',
  floor: '#1c232b',
  grid: '#252e38',
  wall: '#3b4754',
  block: '#36424e',
  glass: '#5b7083',
  edge: '#718294',
  carrier: '#9db0bf',
  machine: '#566574',
  working: '#1FB58A',
  held: '#E69F00',
  recovering: '#56B4E9',
  station: '#5c6d7d',
  route: '#44525f',
  closed: '#F0742E',
  ink: '#e9eef3',
  muted: '#98a5b3',
  paper: '#12161b',
  stripe: '#181d23',
  line: '#262e37',
  axis: '#46525f',
  wait: '#303a44',
};

export const THEMES: Record<ThemeName, Theme> = { light: LIGHT, dark: DARK };

export const pickFrom = (colours: readonly string[], index: number): string => colours[index % colours.length]!;

/** Index into `kinds`: people first, then robots, then others in order of the log. */
export function kindIndex(kind: string, all: readonly string[]): number {
  if (kind === 'human') return 0;
  if (kind === 'robot') return 1;
  return 2 + all.filter((other) => other !== 'human' && other !== 'robot').indexOf(kind);
}

/** Black or white, whichever reads better on `ground` (#rrggbb). */
export function inkOn(ground: string): string {
  const part = (at: number): number => {
    const value = parseInt(ground.slice(at, at + 2), 16) / 255;
    return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  };
  return 0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5) > 0.18 ? '#10151B' : '#FFFFFF';
}
