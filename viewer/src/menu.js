// Buttons that open a small menu beside them.

let opened = null;

export function menu(button, sheet, { fill } = {}) {
  const set = (open) => {
    if (open && opened && opened !== set) opened(false);
    opened = open ? set : opened === set ? null : opened;
    if (open) fill?.();
    else if (sheet.contains(document.activeElement)) button.focus();
    sheet.hidden = !open;
    button.setAttribute('aria-expanded', String(open));
  };
  const first = () => sheet.querySelector('a, button')?.focus();
  button.addEventListener('click', ({ detail }) => {
    set(sheet.hidden);
    // Keys click, too, and whoever uses them goes on with them.
    if (detail === 0 && !sheet.hidden) first();
  });
  sheet.addEventListener('keydown', (event) => {
    const items = [...sheet.querySelectorAll('a, button')];
    const at = items.indexOf(document.activeElement);
    const move = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    // In a sheet with fields, these keys are theirs.
    if (!move || items.length === 0 || event.target.matches('input, select')) return;
    event.preventDefault();
    event.stopPropagation();
    items[(at + move + items.length) % items.length].focus();
  });
  button.addEventListener('keydown', (event) => {
    if (event.key !== 'ArrowDown') return;
    event.preventDefault();
    event.stopPropagation();
    set(true);
    first();
  });
  sheet.addEventListener('click', (event) => {
    if (sheet.getAttribute('role') === 'menu' && event.target.closest('a, button')) {
      set(false);
      button.focus();
    }
  });
  addEventListener('pointerdown', (event) => {
    if (!sheet.hidden && !sheet.contains(event.target) && !button.contains(event.target)) set(false);
  });
  return set;
}

/** Closes the open menu. Returns whether there was one. */
export function closeMenu() {
  if (!opened) return false;
  opened(false);
  return true;
}
