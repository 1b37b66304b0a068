// Symbols of ISO 1101 as paths in a box of 12 px, for typefaces often lack them.
const circle = (r: number) => `M${6 - r},6a${r},${r} 0 1 0 ${2 * r},0a${r},${r} 0 1 0 ${-2 * r},0`;
const arrow = (x: number) => `M${x},11L${x + 5},2m-3.4,1.6l3.4,-1.6l0.2,3.6`;

export const symbols: Record<string, string> = {
  straightness: 'M0.5,6H11.5',
  flatness: 'M3.5,2.5H11.5L8.5,9.5H0.5Z',
  circularity: circle(4),
  cylindricity: `${circle(2.8)}M0.5,11L4,1M8,11L11.5,1`,
  profile: 'M1,9A5,5 0 0 1 11,9',
  'profile-without-datum': 'M1,9A5,5 0 0 1 11,9',
  parallelism: 'M2,11L6,1M6,11L10,1',
  perpendicularity: 'M1,10.5H11M6,10.5V1',
  angularity: 'M10.5,2L1,10.5H11',
  position: `${circle(3.4)}M0.5,6H11.5M6,0.5V11.5`,
  coaxiality: circle(4.4) + circle(2),
  'circular-radial-runout': arrow(3),
  'circular-axial-runout': arrow(3),
  'total-radial-runout': `${arrow(1)}${arrow(6)}M1,11h5`,
  'total-axial-runout': `${arrow(1)}${arrow(6)}M1,11h5`,
};
