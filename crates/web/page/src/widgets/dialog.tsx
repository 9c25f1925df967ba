// A modal dialog on the browser's own: it keeps the focus inside, Escape closes it, and the focus goes back after.

import type { ComponentChildren } from "preact";
import { useId, useLayoutEffect, useRef } from "preact/hooks";
import { Button } from "./button.tsx";

interface DialogProps {
  title: string;
  onClose(): void;
  children: ComponentChildren;
}

export function Dialog({ title, onClose, children }: DialogProps) {
  const dialog = useRef<HTMLDialogElement>(null);
  const titleId = useId();
  // Before the next event is taken: who types on while the dialog goes would lose the focus to the button behind it.
  useLayoutEffect(() => {
    const before = document.activeElement;
    const shown = dialog.current;
    shown?.showModal();
    return () => {
      shown?.close();
      if (before instanceof HTMLElement) before.focus();
    };
  }, []);
  return (
    <dialog
      class="dialog"
      ref={dialog}
      aria-labelledby={titleId}
      onClose={(event) => event.currentTarget.isConnected && onClose()}
      onClick={(event) => {
        // The dialog itself is hit only outside what it holds.
        if (event.target === dialog.current) onClose();
      }}
    >
      <div class="inside">
        <header>
          <h2 id={titleId}>{title}</h2>
          <Button label="Close" icon="close" bare kind="plain" onClick={onClose} />
        </header>
        {children}
      </div>
    </dialog>
  );
}
