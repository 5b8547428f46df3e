// Light or dark: as the system says, until the switch says otherwise.

const KEY = 'burgeon-theme';
const system = matchMedia('(prefers-color-scheme: dark)');

export function dark() {
  const chosen = document.documentElement.dataset.theme;
  return chosen ? chosen === 'dark' : system.matches;
}

/** `changed` is called now and after each change. */
export function listen(button, changed) {
  const kept = remembered();
  if (kept) document.documentElement.dataset.theme = kept;
  button.addEventListener('click', () => {
    const next = dark() ? 'light' : 'dark';
    document.documentElement.dataset.theme = next;
    try {
      localStorage.setItem(KEY, next);
    } catch {
      // A browser that keeps nothing still switches.
    }
    changed();
  });
  system.addEventListener('change', changed);
  changed();
}

function remembered() {
  try {
    const kept = localStorage.getItem(KEY);
    return kept === 'light' || kept === 'dark' ? kept : null;
  } catch {
    return null;
  }
}

/** The picture's background, top and bottom. */
export function background() {
  const style = getComputedStyle(document.documentElement);
  return [style.getPropertyValue('--sky').trim(), style.getPropertyValue('--floor').trim()];
}
