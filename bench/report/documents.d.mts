export function figuresPage(record: object): string;
export function headlineOf(record: object): string;
export function putHeadline(readme: string, headline: string): string;
