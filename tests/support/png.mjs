// The parts that PNG files consist of.

const word = (value) => {
  const bytes = Buffer.alloc(4);
  bytes.writeUInt32BE(value >>> 0);
  return bytes;
};

function crc32(data) {
  let crc = -1;
  for (const byte of data) {
    crc ^= byte;
    for (let i = 0; i < 8; i++) crc = crc >>> 1 ^ (crc & 1 ? 0xEDB88320 : 0);
  }
  return ~crc;
}

export const PNG_SIGNATURE = Buffer.from([0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A]);

export function pngChunk(name, data) {
  const named = Buffer.concat([Buffer.from(name), data]);
  return Buffer.concat([word(data.length), named, word(crc32(named))]);
}

/** @param color  type: 0 grey, 6 RGBA */
export const pngHeader = (width, height, depth, color) =>
  pngChunk('IHDR', Buffer.concat([word(width), word(height), Buffer.from([depth, color, 0, 0, 0])]));
