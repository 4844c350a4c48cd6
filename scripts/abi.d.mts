export function abi(): string;
