// Buttons: with an icon alone the label is spoken and shown as a hint.

import type { TargetedMouseEvent } from "preact";
import { useId } from "preact/hooks";
import { Icon, type IconName } from "./icons.tsx";

interface ButtonProps {
  label: string;
  icon?: IconName;
  /** Only the icon is drawn. */
  bare?: boolean;
  kind?: "plain" | "main";
  small?: boolean;
  disabled?: boolean;
  pressed?: boolean;
  /** A longer hint than the label. */
  hint?: string;
  class?: string;
  onClick(event: TargetedMouseEvent<HTMLButtonElement>): void;
}

export function Button({ label, icon, bare, kind, small, disabled, pressed, hint, class: extra, onClick }: ButtonProps) {
  const names = ["button", kind, small && "small", bare && "icon", extra].filter(Boolean).join(" ");
  return (
    <button
      type="button"
      class={names}
      // A disabled button keeps its focus, so that undoing the last step does not lose the place in the page.
      aria-disabled={disabled ? "true" : undefined}
      aria-pressed={pressed}
      aria-label={bare ? label : undefined}
      title={hint ?? (bare ? label : undefined)}
      onClick={(event) => {
        if (!disabled) onClick(event);
      }}
    >
      {icon && <Icon name={icon} size={small ? 16 : 18} />}
      {!bare && <span class={icon ? "words" : undefined}>{label}</span>}
    </button>
  );
}

interface SegmentsProps<T extends string> {
  label: string;
  options: { value: T; label: string }[];
  value: T;
  onChange(value: T): void;
}

/** One of a few: radio buttons that look like one control. */
export function Segments<T extends string>({ label, options, value, onChange }: SegmentsProps<T>) {
  const group = useId();
  return (
    <div class="segments" role="radiogroup" aria-label={label}>
      {options.map((option) => (
        <label key={option.value}>
          <input type="radio" name={group} checked={option.value === value} onChange={() => onChange(option.value)} />
          <span>{option.label}</span>
        </label>
      ))}
    </div>
  );
}
