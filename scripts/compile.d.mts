export const lean: string[];
