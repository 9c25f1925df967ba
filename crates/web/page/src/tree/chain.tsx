// The chain of the tree in hand: between which links, what is known of it, and what there was to say of its file.

import { Callout, Findings } from "../widgets/callout.tsx";
import { Button } from "../widgets/button.tsx";
import { Words } from "../widgets/words.tsx";
import { dialog } from "../panels/robots.tsx";
import { choose, nameOf, type Opened, tree } from "./open.ts";

/** Above the table and the joints of a robot that is a chain of a tree. */
export function ChainBar() {
  const opened = tree.value;
  const taken = opened?.answer.tree;
  if (!opened || !taken) return null;
  return (
    <section class="chain" aria-label={`Chain of ${nameOf(opened.choice.main)}`}>
      <Ends opened={opened} onBase={(base) => void choose({ base })} onTip={(tip) => void choose({ tip })} />
      <p class="fine">
        <Words text={`${taken.words}.`} />{" "}
        <Button label="Its file …" kind="plain" small onClick={() => (dialog.value = { part: "tree" })} />
      </p>
    </section>
  );
}

interface EndsProps {
  opened: Opened;
  onBase(base: string): void;
  onTip(tip: string): void;
  isAsked?: boolean;
}

/** The links at which the chain begins and ends. */
export function Ends({ opened, onBase, onTip, isAsked }: EndsProps) {
  const taken = opened.answer.tree;
  if (!taken) return null;
  // Until the chain is another one the fields show the present one: there may be none between these links.
  const wanted = (select: HTMLSelectElement, present: string) => {
    const { value } = select;
    select.value = present;
    return value;
  };
  const others = taken.links.filter((link) => !taken.tips.includes(link));
  return (
    <div class="ends-of-chain">
      <label class="labelled">
        From
        <select class="field" value={taken.base} onChange={(event) => onBase(wanted(event.currentTarget, taken.base))}>
          {taken.links.map((link) => (
            <option key={link} value={link}>
              {link}
            </option>
          ))}
        </select>
      </label>
      <label class={isAsked ? "labelled asked" : "labelled"}>
        To
        <select class="field" value={taken.tip ?? ""} aria-invalid={isAsked ? "true" : undefined} onChange={(event) => onTip(wanted(event.currentTarget, taken.tip ?? ""))}>
          {taken.tip === null && <option value="">Choose</option>}
          <optgroup label={taken.tip === null ? "Most joints on the way" : "Ends of the tree"}>
            {taken.tips.map((link) => (
              <option key={link} value={link}>
                {link}
              </option>
            ))}
          </optgroup>
          {others.length > 0 && (
            <optgroup label="Other links">
              {others.map((link) => (
                <option key={link} value={link}>
                  {link}
                </option>
              ))}
            </optgroup>
          )}
        </select>
      </label>
    </div>
  );
}

/** What there is to say of a description: errors at once, notes behind their number. */
export function Remarks({ opened }: { opened: Opened }) {
  const { findings } = opened.answer;
  const errors = findings.filter(({ severity }) => severity === "error");
  const rest = findings.filter(({ severity }) => severity !== "error");
  const warnings = rest.filter(({ severity }) => severity === "warning").length;
  const counted = [count(warnings, "warning"), count(rest.length - warnings, "note")].filter(Boolean).join(", ");
  return (
    <>
      <Findings findings={errors} />
      {errors.length > 0 && rest.length > 0 ? (
        <details class="section">
          <summary>{counted}</summary>
          <Findings findings={rest} />
        </details>
      ) : (
        <Findings findings={rest} />
      )}
      {findings.length === 0 && <Callout tone="good">Nothing in the file needs a remark.</Callout>}
    </>
  );
}

function count(n: number, word: string): string {
  return n === 0 ? "" : `${n} ${word}${n === 1 ? "" : "s"}`;
}
