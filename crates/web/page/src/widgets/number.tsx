// A field for one number with its unit. What is typed stays as typed until it is done; Escape takes it back.

import type { TargetedKeyboardEvent } from "preact";
import { useId, useState } from "preact/hooks";
import { look } from "../state.ts";
import { keyStep, type Measure, parse, plain, unitOf, unitWords } from "../units.ts";

interface NumberFieldProps {
  label: string;
  value: number;
  measure: Measure;
  onChange(value: number): void;
  /** Arrow keys up and down step the value; `false` leaves them alone. */
  steps?: boolean;
  invalid?: boolean;
  /** Ids of what describes the field. */
  describedBy?: string;
  onFocus?(): void;
  onBlur?(): void;
}

export function NumberField({ label, value, measure, onChange, steps = true, invalid, describedBy, onFocus, onBlur }: NumberFieldProps) {
  const units = look.value;
  const [typed, setTyped] = useState<string | null>(null);
  const [problem, setProblem] = useState<string | null>(null);
  const problemId = useId();
  const unit = unitOf(measure, units);

  /** Takes what was typed, if it is a number. */
  const commit = (): boolean => {
    if (typed === null) return true;
    const parsed = parse(typed, measure, units);
    if ("problem" in parsed) {
      setProblem(parsed.problem);
      return false;
    }
    setTyped(null);
    setProblem(null);
    onChange(parsed.value);
    return true;
  };

  const onKeyDown = (event: TargetedKeyboardEvent<HTMLInputElement>) => {
    if (event.key === "Enter" && commit()) {
      event.preventDefault();
      event.currentTarget.select();
    } else if (event.key === "Escape" && typed !== null) {
      // The dialog or panel around stays open: the first Escape belongs to the text.
      event.stopPropagation();
      event.preventDefault();
      setTyped(null);
      setProblem(null);
    } else if (steps && (event.key === "ArrowUp" || event.key === "ArrowDown") && typed === null) {
      event.preventDefault();
      onChange(value + (event.key === "ArrowUp" ? 1 : -1) * keyStep(measure, event));
    }
  };

  return (
    <span class="number-field">
      <span class="with-unit">
        <input
          class="field number"
          type="text"
          inputMode="text"
          autocomplete="off"
          spellcheck={false}
          aria-label={unit ? `${label}, ${unitWords(measure, units)}` : label}
          aria-invalid={problem !== null || invalid ? "true" : undefined}
          aria-describedby={[problem !== null && problemId, describedBy].filter(Boolean).join(" ") || undefined}
          data-unit={unit || undefined}
          value={typed ?? plain(value, measure, units)}
          onInput={(event) => {
            setTyped(event.currentTarget.value);
            setProblem(null);
          }}
          onFocus={(event) => {
            event.currentTarget.select();
            onFocus?.();
          }}
          onBlur={() => {
            commit();
            onBlur?.();
          }}
          onKeyDown={onKeyDown}
        />
        {unit && (
          <span class="unit" aria-hidden="true">
            {unit}
          </span>
        )}
      </span>
      {problem !== null && (
        <span class="problem" id={problemId} role="alert">
          {problem}
        </span>
      )}
    </span>
  );
}
