// The machine of the figures, and the name of their file: processor and platform, never the host's name.
import os from 'node:os';

export const machine = {
  cpu: os.cpus()[0]?.model.trim() ?? 'unknown',
  cores: os.cpus().length,
  memory: os.totalmem(),
  system: `${os.platform()} ${os.arch()}`,
  node: process.version,
  v8: process.versions.v8,
};

export const machineName = `${machine.cpu} ${machine.system}`
  .toLowerCase()
  .replace(/\((r|tm)\)/g, '')
  .replace(/[^a-z0-9]+/g, '-')
  .replace(/^-|-$/g, '');
