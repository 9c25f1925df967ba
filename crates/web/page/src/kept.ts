// The page without a network: kept by a service worker where somebody asks for it. It fetches all parts of the engine, which a
// visit does not; and `denavit view` has another address each time, under which nothing is worth keeping.

import { signal } from "@preact/signals";
import { said } from "./state.ts";

export type Kept = "no" | "fetching" | "yes";
export const kept = signal<Kept>("no");

const HERE = ["127.0.0.1", "localhost", "[::1]"];

/** Whether the page comes from a place that stays: not from `denavit view`, not from a file. */
export function canBeKept(): boolean {
  const isServedOnce = HERE.includes(location.hostname) && /^\/[0-9a-f]{16,}\//.test(location.pathname);
  return "serviceWorker" in navigator && /^https?:$/.test(location.protocol) && !isServedOnce;
}

/** Tells the browser that the page can be installed. */
function install(): void {
  if (document.querySelector('link[rel="manifest"]')) return;
  const link = document.createElement("link");
  [link.rel, link.href] = ["manifest", new URL("manifest.json", document.baseURI).href];
  document.head.append(link);
}

/** At the start: offers to install, and asks whether it is kept already. */
export async function lookIfKept(): Promise<void> {
  if (!canBeKept()) return;
  if (!HERE.includes(location.hostname)) install();
  const registration = await navigator.serviceWorker.getRegistration();
  if (registration?.active) kept.value = "yes";
}

export async function keep(): Promise<void> {
  try {
    kept.value = "fetching";
    install();
    const registration = await navigator.serviceWorker.register(new URL("sw.js", document.baseURI));
    const worker = registration.installing ?? registration.waiting ?? registration.active;
    await new Promise<void>((resolve, reject) => {
      const look = () => {
        if (worker?.state === "activated") resolve();
        else if (!worker || worker.state === "redundant") reject(new Error("The files of the page could not be fetched."));
      };
      worker?.addEventListener("statechange", look);
      look();
    });
    kept.value = "yes";
  } catch (why) {
    kept.value = "no";
    said(why);
  }
}

export async function letGo(): Promise<void> {
  const registration = await navigator.serviceWorker.getRegistration();
  await registration?.unregister();
  const names = (await caches.keys()).filter((name) => name.startsWith("denavit-"));
  await Promise.all(names.map((name) => caches.delete(name)));
  kept.value = "no";
}
