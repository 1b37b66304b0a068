// Files of the shop for /v1/review and /v1/learn: NC programs, and results of measured parts.
import { loadDraft } from './drafts';
import { t } from './language';
import type { Part } from './types';

export interface Text {
  name: string;
  text: string;
}

export const controls = [
  { id: 'linuxcnc', name: 'LinuxCNC', ending: /\.ngc$/i },
  { id: 'fanuc', name: t("Fanuc, system A"), ending: /\.nc$/i },
  { id: 'fanuc-b', name: t("Fanuc, system B"), ending: /$^/ },
  { id: 'haas', name: 'Haas', ending: /$^/ },
  { id: 'siemens-iso', name: t("Siemens 840D, ISO mode"), ending: /$^/ },
  { id: 'siemens', name: 'Siemens 840D', ending: /\.mpf$/i },
  { id: 'okuma', name: 'Okuma OSP', ending: /\.min$/i },
];

/** The control that a program's file is called for. */
export const controlOf = (name: string): string => controls.find((c) => c.ending.test(name))?.id ?? 'fanuc';

/** The part of this tab of the browser, as it stands on the tab Plan. */
export function partOnDesk(local: Storage, session: Storage): Part | undefined {
  const id = session.getItem('turnwright-draft');
  return id ? loadDraft(local, id)?.part : undefined;
}

/** "1 PCLNL-CNMG120408-PM" and "2 DRILL-HM-5D 19 mm", a line each; what is no tool is named. */
export function readTurret(text: string): { tools: Part[]; wrong: string[] } {
  const tools: Part[] = [];
  const wrong: string[] = [];
  for (const line of text.split('\n').map((l) => l.trim()).filter(Boolean)) {
    const found = /^T?(\d+)\s*[=: ]\s*(\S+)(?:\s+(\d+(?:[.,]\d+)?)\s*(?:mm)?)?$/i.exec(line);
    if (!found) wrong.push(line);
    else
      tools.push({
        number: Number(found[1]), id: found[2], ...(found[3] && { size_mm: Number(found[3].replace(',', '.')) }),
      });
  }
  return { tools, wrong };
}

/** Programs of setups that follow each other. */
export function reviewRequest(part: Part, control: string, programs: Text[], tools: Part[], first = 0): Part {
  return {
    part, control, programs: programs.map(({ text }, i) => ({ setup: first + i, text })), ...(tools.length && { tools }),
  };
}

const isQif = ({ name, text }: Text) => /\.qif$/i.test(name) || text.trimStart().startsWith('<');

/** One table, or files of QIF; why they are neither. */
export function learnRequest(files: Text[], part?: Part): { request?: Part; why?: string } {
  const qif = files.filter(isQif);
  const given = part ? { part } : {};
  if (qif.length === files.length) return { request: { ...given, qif: { files: qif.map((f) => f.text) } } };
  if (qif.length) return { why: t("A table and files in QIF are two requests.") };
  if (files.length > 1) return { why: t("{} tables: a request has one.", files.length) };
  return { request: { ...given, csv: files[0].text } };
}
