// How the pages write numbers.
const whole = new Intl.NumberFormat('en', { maximumFractionDigits: 0 });
const threeDigits = new Intl.NumberFormat('en', { minimumSignificantDigits: 3, maximumSignificantDigits: 3 });

export const formatCount = (count: number): string => whole.format(count);

/** Milliseconds with three digits, without decimals from 100 on. The finest clocks tick every 0.005 ms. */
export function formatMilliseconds(ms: number): string {
  if (ms >= 100) return whole.format(ms);
  return ms < 0.1 ? ms.toFixed(3) : threeDigits.format(ms);
}

/** Per second. */
export const formatRate = (rate: number): string => (rate < 10 ? rate.toFixed(1) : whole.format(rate));

export function formatShare(share: number): string {
  const percent = 100 * share;
  if (percent >= 10) return `${whole.format(percent)} %`;
  return percent < 0.001 ? '< 0.001 %' : `${Number(percent.toPrecision(percent < 1 ? 1 : 2))} %`;
}
