export interface Goal {
  goal: string;
  figure: string;
  met?: boolean;
}
export function goals(record: object): Goal[];
