// Words of the documents as people read them: kinds, limits, places.
import { later, t, translated } from './language';

/** What ids of the documents say, with spaces for hyphens. */
export const known: string[] = [
  // elements and milled places
  later("cylinder"), later("cone"), later("arc"), later("groove"), later("thread"), later("hole"), later("as stock"),
  later("keyway"), later("slot"), later("flat"), later("cross hole"), later("wall"), later("part"), later("convex"), later("concave"),
  // tolerances, verdicts, what takes their width
  later("diameter"), later("length"), later("straightness"), later("circularity"), later("flatness"), later("cylindricity"),
  later("profile"), later("profile without datum"), later("parallelism"), later("perpendicularity"), later("angularity"),
  later("position"), later("coaxiality"), later("circular radial runout"), later("circular axial runout"),
  later("total radial runout"), later("total axial runout"), later("met"), later("met with offset"), later("not met"),
  later("deflection"), later("machine"), later("forces"), later("jaw squeeze"), later("chain"), later("drift"),
  later("repeatability"), later("wear"), later("life"), later("heat"), later("rechucking"), later("measurement"),
  // setups, operations, proofs
  later("left"), later("right"), later("chuck"), later("chuck tailstock"), later("between centres"), later("chuck steady"),
  later("tailstock follow"), later("hard"), later("soft"), later("collet"), later("face"), later("rough"), later("finish"),
  later("bore rough"), later("bore finish"), later("fixed"), later("local"),
  later("rapid"), later("feed"), later("milling"), later("turning"), later("down"), later("up"), later("auto"), later("light"), later("dark"),
  // causes of a ball bar's trace
  later("centre offset"), later("mean scale"), later("scale mismatch"), later("squareness"), later("straightness v of u"),
  later("straightness u of v"), later("backlash u"), later("backlash v"), later("lateral play v of u"),
  later("lateral play u of v"), later("servo mismatch"),
  // limits of operations
  later("tolerance"), later("least depth of cut"), later("largest depth of cut"), later("depth of cut"), later("least feed"),
  later("largest feed"), later("least feed of the chip breaker"), later("largest feed of the chip breaker"), later("feed speed"),
  later("least cutting speed"), later("largest cutting speed"), later("cutting speed"), later("roughness Ra"), later("roughness Rz"),
  later("power"), later("torque"), later("feed force"), later("cutting force"), later("grip of the chuck"), later("grip force"),
  later("finishing grip force"), later("least spindle speed"), later("largest spindle speed"), later("spindle speed"),
  later("spindle speed that leaves a third of the grip"), later("least tool life"), later("longest tool life"),
  later("chatter stiffness"), later("stable depth with its margin"), later("compliance of the part"), later("chip thickness"),
  later("least chip thickness"),
  // members of machines and tools
  later("allowance"), later("axes"), later("axis"), later("bar"), later("body"), later("bore"), later("budget"),
  later("c axis"), later("centre cutting"), later("centres"), later("change"), later("chuck axial"), later("chuck radial"),
  later("chuck tangential"), later("clampings"), later("conditions"), later("cost per"), later("currency"), later("curve"),
  later("damping ratio"), later("depths"), later("designation"), later("drift axial"), later("driven tools"),
  later("economics"), later("edge cost"), later("edges"), later("efficiency"), later("errors"), later("f per"), later("feed force max"),
  later("feed max"), later("first diameters"), later("form"), later("frequency"), later("friction"), later("geometry"),
  later("grade"), later("groups"), later("hard jaws"), later("head centre"), later("holder"), later("index"), later("insert"),
  later("jaw mass radius"), later("jaws z"), later("lead"), later("lead pitches"), later("life between offsets"), later("life feed"),
  later("live centre"), later("load"), later("longest"), later("min bore"), later("minor kapr"), later("modes"), later("name"),
  later("note"), later("part warm"), later("passes per"), later("pecking"), later("pitch"), later("point"),
  later("point length"), later("radial"), later("rate"), later("reach"), later("reach diameters"), later("room"),
  later("segments"), later("setup"), later("sizes"), later("soft jaws"), later("source"), later("spindle"), later("stations"),
  later("steady"), later("steady rest"), later("step diameters"), later("stiffness"), later("strength"), later("swing"),
  later("tail centre"), later("tail thrust"), later("tailstock"), later("tangential"), later("taylor n"), later("threads"), later("times"),
  later("tip offset"), later("tool point"), later("uncertainty"), later("use"), later("uses"), later("window"), later("wiper"),
];

/** "total-radial-runout" as words. */
export const words = (id: string): string => translated(id.replaceAll(/[-_]/g, ' '));

/** Choices of a field by their ids. */
export const choices = (ids: string[]): { id: string; name: string }[] => ids.map((id) => ({ id, name: words(id) }));

/** "left" of an end of the part in words. */
export const endOf = (end: string): string => (end === 'left' ? t("left end") : t("right end"));

/** Of a certificate that tells no gap. */
export const proofOf = (kind: string): string => (kind === 'none' ? t("not proven") : words(kind));

/** Ids of surfaces stay, "left" and "right" are words: "left", "d1", "right|b1", "left .. d1". */
export const place = (id: string): string => id.replace(/(?<=^|\||\.\. )(left|right)(?=$|\|| \.\.)/g, words);

/** A limit by its name: "power", "power of lathe-medium", "grip force in setup 1", "t1 flatness", "cost +5 %". */
export function limit(name: string): string {
  if (known.includes(name)) return translated(name);
  const [, what, of, setup] = /^(.+?)(?: of (\S+)| in setup (\d+))$/.exec(name) ?? [];
  if (of) return `${translated(what)} ${t("of {}", place(of))}`;
  if (setup) return t("{} in setup {}", translated(what), setup);
  const [, cost] = /^cost (.*)$/.exec(name) ?? [];
  if (cost) return t("cost {}", cost);
  const [, id, kind] = /^(\S+) (\S+)$/.exec(name) ?? [];
  return known.includes(kind?.replaceAll('-', ' ')) ? `${id} ${words(kind)}` : name;
}
