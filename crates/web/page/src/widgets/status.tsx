// The line at the foot of the page: what happened last, said aloud politely.

import { useEffect } from "preact/hooks";
import { message, robot } from "../state.ts";
import { Button } from "./button.tsx";
import { Icon } from "./icons.tsx";
import { sentence } from "./words.tsx";

/** A note goes after so long, milliseconds; an error stays. */
const NOTE_STAYS = 8000;

export function StatusLine({ resting }: { resting: string }) {
  const now = message.value;
  useEffect(() => {
    if (now?.severity !== "note") return;
    const timer = setTimeout(() => {
      if (message.value === now) message.value = null;
    }, NOTE_STAYS);
    return () => clearTimeout(timer);
  }, [now]);
  const words = now ? [now.words, now.hint].map((part) => part && sentence(part)).filter(Boolean).join(" ").replaceAll("`", "") : "";
  return (
    <footer class="bottom">
      <div class={now?.severity === "error" ? "status error" : "status"}>
        {now?.severity === "error" && <Icon name="error" size={15} />}
        <span role="status" aria-live="polite" title={words || undefined}>
          {words}
        </span>
        {!now && <span>{resting}</span>}
        {now?.severity === "error" && <Button label="Dismiss the message" icon="close" bare kind="plain" onClick={() => (message.value = null)} />}
      </div>
      {robot.value && (
        <span class="structure" title={robot.value.structure.schematic}>
          {robot.value.structure.schematic}
        </span>
      )}
    </footer>
  );
}
