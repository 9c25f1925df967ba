// The engine's words as a sentence on the page: a capital first, names between backticks set as code.

export function Words({ text }: { text: string }) {
  const parts = text.split(/`([^`]*)`/);
  return (
    <>
      {parts.map((part, index) => (index % 2 === 1 ? <code key={index}>{part}</code> : index === 0 ? capital(part) : part))}
    </>
  );
}

export function capital(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

/** With a full stop, where there is no other end. */
export function sentence(text: string): string {
  return text === "" || /[.!?:]$/.test(text) ? capital(text) : `${capital(text)}.`;
}
