// A text area with marks behind its text: a mirror of the text lies below it, letter on letter.

import type { RefObject } from "preact";
import { useEffect, useRef } from "preact/hooks";
import type { Span } from "./text.ts";

interface Props {
  text: string;
  spans: Span[];
  /** The claim whose place is shown. */
  chosen: number | null;
  area: RefObject<HTMLTextAreaElement | null>;
  onInput: (text: string) => void;
  onSubmit: () => void;
  describedBy: string;
}

export function MarkedArea({ text, spans, chosen, area, onInput, onSubmit, describedBy }: Props) {
  const mirror = useRef<HTMLDivElement>(null);
  const follow = () => {
    if (mirror.current && area.current) mirror.current.scrollTop = area.current.scrollTop;
  };
  useEffect(follow, [text, spans]);
  useEffect(() => {
    const mark = chosen === null ? null : mirror.current?.querySelector<HTMLElement>(`[data-claim="${chosen}"]`);
    if (!mark || !area.current) return;
    // What is selected by a script is not brought into view by the browser.
    area.current.scrollTop = Math.max(0, mark.offsetTop - area.current.clientHeight / 3);
    follow();
  }, [chosen, spans]);

  return (
    <div class="marked-area">
      <div class="mirror" ref={mirror} aria-hidden="true">
        {pieces(text, spans)}
        {/* A last empty line has a height only with something in it. */}
        {"\n "}
      </div>
      <textarea
        ref={area}
        class="field"
        aria-label="Formulas to check"
        aria-describedby={describedBy}
        spellcheck={false}
        autocomplete="off"
        placeholder={"Paste formulas, or a whole document: Markdown, LaTeX, Python, MATLAB.\n\nT06 = …   A3 = …   P_x = …   theta_1 = atan2(…)"}
        value={text}
        onInput={(event) => onInput(event.currentTarget.value)}
        onScroll={follow}
        onKeyDown={(event) => {
          if (event.key !== "Enter" || !(event.ctrlKey || event.metaKey)) return;
          event.preventDefault();
          onSubmit();
        }}
      />
    </div>
  );
}

function pieces(text: string, spans: Span[]) {
  let done = 0;
  const out = spans.flatMap((span, k) => {
    const between = text.slice(done, span.from);
    done = span.to;
    return [
      between,
      <mark key={k} class={`at-${span.verdict}`} data-claim={span.claim}>
        {text.slice(span.from, span.to)}
      </mark>,
    ];
  });
  return [...out, text.slice(done)];
}
