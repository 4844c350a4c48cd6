export function figuresPage(record: object): string;
export function headlineOf(record: object): string;
export function worthOf(record: object): string;
export function putFigures(text: string, figures: string): string;
