// What a key stands for, if it stands for something.

export function byKey<T>(event: { key: string }, meanings: Record<string, T>): T | undefined {
  return Object.hasOwn(meanings, event.key) ? meanings[event.key] : undefined;
}
