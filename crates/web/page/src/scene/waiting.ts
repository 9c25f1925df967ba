// What is being computed for the scene, to be said with a way to cancel when it takes longer than a moment.

import { signal } from "@preact/signals";

export interface Waiting {
  words: string;
  cancel: () => void;
}

export const waiting = signal<Waiting[]>([]);
const MOMENT = 300;

export function wait(words: string, cancel: () => void): { begin: () => void; finish: () => void } {
  const one: Waiting = { words, cancel };
  let timer = 0;
  return {
    begin: () => {
      timer = window.setTimeout(() => (waiting.value = [...waiting.value, one]), MOMENT);
    },
    finish: () => {
      clearTimeout(timer);
      waiting.value = waiting.value.filter((other) => other !== one);
    },
  };
}
