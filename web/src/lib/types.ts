// The members of the documents that the page shows; schemas/ have all of them.

/** A part document; its members are the planner's to write, so anything may stand there. */
// eslint-disable-next-line @typescript-eslint/no-explicit-any
export type Part = Record<string, any>;

export interface Entry {
  id: string;
  name: string;
}

export type Pair = [number, number];

export interface Surface {
  id: string;
  side: 'outer' | 'inner';
  kind: 'cylinder' | 'cone' | 'arc' | 'groove' | 'thread' | 'hole' | 'as-stock';
  z_mm: Pair;
  diameters_mm: Pair;
  /** Of a chamfer: along the axis and on the radius. */
  left_chamfer_mm?: Pair;
  right_chamfer_mm?: Pair;
  left_radius_mm?: number;
  right_radius_mm?: number;
  left_fillet_mm?: number;
  right_fillet_mm?: number;
  left_undercut?: string;
  right_undercut?: string;
  pitch_mm?: number;
  /** Of DIN 82, "RAA0.8", and the diameter that is turned before. */
  knurl?: string;
  blank_mm?: number;
  radius_mm?: number;
  convex?: boolean;
  fit?: string;
  limits_mm?: Pair;
  Ra_um?: number;
  Rz_um?: number;
  setup?: number;
}

export interface Face {
  id: string;
  z_mm: number;
  Ra_um?: number;
  Rz_um?: number;
  /** "ISO 6411-A4/8.5", in an end that is asked for one. */
  centre_hole?: string;
  setup?: number;
}

export interface DrawnTolerance {
  id: string;
  kind: string;
  of?: string;
  datum?: string;
  between?: [string, string];
  value_mm: number;
  limits_mm?: Pair;
}

export interface DrawnSetup {
  hold: 'left' | 'right';
  grip_mm: number;
  jaws_z_mm: number;
  steady_z_mm?: number;
  clampings: string[];
}

/** A cylinder or cone of a casting or forging. */
export interface StockPiece {
  length_mm: number;
  left_mm: number;
  right_mm: number;
}

export interface Drawing {
  name: string;
  length_mm: number;
  stock: { z_mm: Pair; outer_mm: number; inner_mm: number; flats?: number; across_flats_mm?: number; outline?: StockPiece[] };
  elements: Surface[];
  faces: Face[];
  tolerances: DrawnTolerance[];
  setups: DrawnSetup[];
  unreachable: string[];
}

export interface Certificate {
  kind: 'global' | 'local' | 'none';
  lower_bound: number;
  gap: number;
  nodes: number;
  engine?: string;
  reason?: string;
}

export interface Pass {
  ap_mm: number;
  f_mm_rev: number;
  vc_m_min: number;
  n_rpm: number;
}

export interface Constraint {
  name: string;
  value: number;
  limit: number;
  unit: string;
  at_most: boolean;
  margin: number;
  binding: boolean;
  shadow_price: number;
}

export interface OperatingWindow {
  percent: number;
  vc_m_min: number[];
  f_mm_rev: number[];
  limits: string[];
}

export interface Operation {
  id: string;
  kind: string;
  on: string[];
  tool: string;
  direction: string;
  passes: Pass[];
  time_min: number;
  cost: number;
  constraints: Constraint[];
  certificate: Certificate;
  window?: OperatingWindow;
}

export interface Setup {
  hold: string;
  clamping: string;
  grip_force_N: number;
  rejected: { clamping: string; why: string }[];
  operations: Operation[];
}

export interface Tolerance {
  id: string;
  kind: string;
  of: string;
  predicted_mm: number | Pair;
  allowed_mm: number | Pair;
  margin_mm: number;
  width_mm: number;
  verdict: 'met' | 'met-with-offset' | 'not-met';
  shares: { source: string; um: number }[];
  P_conform: number;
}

export interface OnSurface {
  on: string;
  setup: number;
  table_mm: Pair[];
}

export interface Sentence {
  sentence: string;
}

/** Of limits that cannot be kept together: the set that it belongs to. */
export interface InSet extends Sentence {
  set?: number;
}

export interface Price extends Sentence {
  limit: string;
  saves_per_part_for_10_percent: number;
}

export interface Corner {
  cost_per_part: number;
  time_per_part_min: number;
  minute_worth?: number;
}

export interface WhatIfAnswer extends Sentence {
  name: string;
  status: 'ok' | 'infeasible';
  saves_per_part: number | null;
}

export interface Plan {
  status: 'ok' | 'infeasible';
  currency?: string;
  cost_per_part: number | null;
  time_per_part_min: number | null;
  worst_conformance?: { tolerance: string; P_conform: number; wanted: number };
  setting_up?: { min: number; cost: number; min_per_part: number | null; cost_per_part: number | null };
  certificate: Certificate;
  setups: Setup[];
  tolerances: Tolerance[];
  deviations: OnSurface[];
  offsets: { on: string; setup: number; offset_mm: number }[];
  compensation: OnSurface[];
  pareto?: Corner[];
  prices: Price[];
  what_if?: WhatIfAnswer[];
  /** The part without each rule of the shop. */
  rules?: Sentence[];
  conflicts: InSet[];
  relax: InSet[];
  remedies?: Sentence[];
  assumed: { pointer: string; value: unknown; why: string }[];
  turnwright_version: string;
  request_digest: string;
}

/** What an import assumed or ignored. */
export interface Remark {
  at: string;
  text: string;
}

/** Tools of a library; a remark may hold for many places. */
export interface ImportedTools {
  tools: Part[];
  assumed: PlacedRemark[];
  contradictions: PlacedRemark[];
  ignored: PlacedRemark[];
}
export interface PlacedRemark {
  at: string[];
  text: string;
}

export interface Imported {
  part: Part;
  assumed: Remark[];
  ignored: Remark[];
}
