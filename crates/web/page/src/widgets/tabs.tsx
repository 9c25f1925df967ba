// Tabs as the ARIA practices have them: arrows move and choose, one tab stop.

import type { TargetedKeyboardEvent } from "preact";
import { byKey } from "./keys.ts";

interface TabsProps<T extends string> {
  label: string;
  /** Begins the ids of tabs and panels: `side-tab-joints`, `side-panel-joints`. */
  id: string;
  tabs: { value: T; label: string; mark?: string }[];
  value: T;
  onChange(value: T): void;
}

export function tabId(id: string, value: string): string {
  return `${id}-tab-${value}`;
}

export function panelId(id: string): string {
  return `${id}-panel`;
}

export function Tabs<T extends string>({ label, id, tabs, value, onChange }: TabsProps<T>) {
  const onKeyDown = (event: TargetedKeyboardEvent<HTMLDivElement>) => {
    const at = tabs.findIndex((tab) => tab.value === value);
    const next = byKey(event, {
      ArrowRight: (at + 1) % tabs.length,
      ArrowLeft: (at + tabs.length - 1) % tabs.length,
      Home: 0,
      End: tabs.length - 1,
    });
    if (next === undefined) return;
    event.preventDefault();
    onChange(tabs[next].value);
    document.getElementById(tabId(id, tabs[next].value))?.focus();
  };
  return (
    <div class="tabs" role="tablist" aria-label={label} onKeyDown={onKeyDown}>
      {tabs.map((tab) => (
        <button
          key={tab.value}
          type="button"
          role="tab"
          class="tab"
          id={tabId(id, tab.value)}
          aria-selected={tab.value === value}
          aria-controls={panelId(id)}
          tabIndex={tab.value === value ? 0 : -1}
          data-label={tab.label}
          onClick={() => onChange(tab.value)}
          onFocus={(event) => event.currentTarget.scrollIntoView({ block: "nearest", inline: "nearest" })}
        >
          {tab.label}
          {tab.mark && (
            <span class="dot" title={tab.mark}>
              <span class="spoken">{tab.mark}</span>
            </span>
          )}
        </button>
      ))}
    </div>
  );
}
