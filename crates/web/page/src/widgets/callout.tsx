// A boxed remark: an error, a warning, a note, good news.

import type { ComponentChildren } from "preact";
import type { Finding } from "../engine/types.ts";
import { Icon, type IconName } from "./icons.tsx";
import { sentence, Words } from "./words.tsx";

type Tone = "error" | "warning" | "note" | "good";
const ICONS: Record<Tone, IconName> = { error: "error", warning: "error", note: "note", good: "done" };

export function Callout({ tone, children, alert }: { tone: Tone; children: ComponentChildren; alert?: boolean }) {
  return (
    <div class={`callout ${tone}`} role={alert ? "alert" : undefined}>
      <Icon name={ICONS[tone]} size={16} />
      {children}
    </div>
  );
}

/** Findings about a text that was opened, with the place. */
export function Findings({ findings }: { findings: Finding[] }) {
  if (findings.length === 0) return null;
  const worst = findings.some((f) => f.severity === "error") ? "error" : findings.some((f) => f.severity === "warning") ? "warning" : "note";
  return (
    <Callout tone={worst} alert>
      <ul class="findings">
        {findings.map((finding, index) => (
          <li key={index}>
            {finding.at && (
              <span class="quiet">
                {finding.source ? `${finding.source}, line` : "Line"} {finding.at.line}, column {finding.at.column}:{" "}
              </span>
            )}
            <Words text={sentence(finding.message)} />
            {finding.hint && (
              <span class="quiet">
                {" "}
                <Words text={sentence(finding.hint)} />
              </span>
            )}
          </li>
        ))}
      </ul>
    </Callout>
  );
}
