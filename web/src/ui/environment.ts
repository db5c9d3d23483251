// What the page learns from the browser around it.

import type { ThemeName } from './theme';

/** Files that are dropped anywhere on the page. */
export function acceptDrops(open: (files: FileList) => void): void {
  document.addEventListener('dragover', (event) => event.preventDefault());
  document.addEventListener('drop', (event) => {
    event.preventDefault();
    if (event.dataTransfer?.files.length) open(event.dataTransfer.files);
  });
}

const darkness = window.matchMedia('(prefers-color-scheme: dark)');

export function preferredTheme(): ThemeName {
  return darkness.matches ? 'dark' : 'light';
}

export function whenThemeChanges(changed: (theme: ThemeName) => void): void {
  darkness.addEventListener('change', () => changed(preferredTheme()));
}
