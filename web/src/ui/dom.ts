// Makes elements. Text from files only ever becomes text: there is no way to pass markup.

type Child = Node | string | undefined | false;

export interface Attributes {
  class?: string;
  title?: string;
  type?: string;
  href?: string;
  role?: string;
  id?: string;
  label?: string; // aria-label
  data?: Record<string, string>;
  onclick?: (event: MouseEvent) => void;
}

export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  const { class: classes, label, data, onclick, ...others } = attributes;
  if (classes) element.className = classes;
  if (label) element.setAttribute('aria-label', label);
  for (const [name, value] of Object.entries(others)) element.setAttribute(name, value);
  for (const [name, value] of Object.entries(data ?? {})) element.dataset[name] = value;
  if (onclick) element.addEventListener('click', onclick as EventListener);
  element.append(...children.filter((child): child is Node | string => child !== undefined && child !== false));
  return element;
}

export function swatch(colour: string, classes = 'swatch'): HTMLElement {
  const mark = el('span', { class: classes });
  mark.style.background = colour;
  return mark;
}

export function button(text: string, title: string, onclick: () => void, classes = ''): HTMLButtonElement {
  return el('button', { type: 'button', title, label: title, class: classes, onclick }, text);
}
