// SPDX-License-Identifier: Apache-2.0
// Elements by their parts. Text goes in as text: nothing here reads markup.

type Child = Node | string | null;

/** An element with attributes and children; a name that begins with "on" is a listener's. */
export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K, attributes: Record<string, unknown> = {}, ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === false) continue;
    if (name.startsWith('on')) {
      element.addEventListener(name.slice(2), value as EventListener);
    } else {
      element.setAttribute(name, value === true ? '' : String(value));
    }
  }
  element.append(...children.filter((child): child is Node | string => child !== null));
  return element;
}

/** A button that says what it does to those who do not see its face. */
export function button(face: string, says: string, onClick: () => void): HTMLButtonElement {
  return el('button', { type: 'button', title: says, 'aria-label': says, onclick: onClick }, face);
}

/** A labelled choice of one of several. */
export function choice(
  label: string, options: [value: string, face: string][], chosen: string,
  onChange: (value: string) => void,
): HTMLLabelElement {
  const select = el('select', { onchange: () => onChange(select.value) });
  for (const [value, face] of options) {
    select.append(el('option', { value, selected: value === chosen }, face));
  }
  return el('label', { class: 'choice' }, `${label} `, select);
}

/** A labelled box to tick. */
export function tick(
  label: string, isOn: boolean, onChange: (isOn: boolean) => void,
): HTMLLabelElement {
  const box = el('input', { type: 'checkbox', checked: isOn, onchange: () => onChange(box.checked) });
  return el('label', { class: 'tick' }, box, ` ${label}`);
}

/** Whether the browser itself does something with it where Space or Enter is pressed. */
export function isPressable(element: Element): boolean {
  return element.matches('button, a[href], summary, select, textarea, input:not([type="range"])');
}

/** A labelled slider over whole numbers. */
export function slider(
  label: string, min: number, max: number, value: number, onInput: (value: number) => void,
): HTMLLabelElement {
  const input = el('input', {
    type: 'range', min, max, value, oninput: () => onInput(Number(input.value)),
  });
  return el('label', { class: 'choice' }, `${label} `, input);
}
