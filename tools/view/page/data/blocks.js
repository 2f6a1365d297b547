// SPDX-License-Identifier: GPL-3.0-or-later
/** Decoding of the page's blocks: base64, zlib, byte planes, differences. */

/** Whether this browser can inflate the blocks. */
export const canDecode = typeof DecompressionStream === "function";

/**
 * The numbers of a block: Float32Array, Float64Array or Int32Array (arithmetic modulo 2^32).
 * Rejects if the element is missing, the stream is damaged or its length is wrong.
 */
export async function readBlock(block) {
  const element = document.getElementById(`block-${block.id}`);
  if (!element) throw new Error(`block ${block.id} is missing from the page`);
  const planes = await inflate(bytesOfBase64(element.textContent));
  if (planes.length !== block.width * block.count) {
    throw new Error(
      `block ${block.id}: expected ${block.width * block.count} bytes, found ${planes.length}`);
  }
  const words = joinPlanes(planes, block.count, block.width);
  if (block.type === "float") return new Float32Array(words.buffer);
  if (block.type === "double") return fromHigherHalves(words);
  if (block.delta > 0) undoDifferences(words, block.delta);
  return new Int32Array(words.buffer); // may be negative
}

function bytesOfBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text.trim());
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Byte k of number i stands at planes[k * count + i]. */
function joinPlanes(planes, count, width) {
  const words = new Uint32Array(count);
  for (let k = 0; k < width; k++) {
    const shift = 8 * k;
    const start = k * count;
    for (let i = 0; i < count; i++) words[i] |= planes[start + i] << shift;
  }
  return words;
}

function fromHigherHalves(words) {
  const number = new DataView(new ArrayBuffer(8));
  return Float64Array.from(words, (word) => {
    number.setUint32(0, word);
    return number.getFloat64(0);
  });
}

/** Number i is a zigzag-coded difference to number i - distance, and to 0 for i < distance. */
function undoDifferences(words, distance) {
  for (let i = 0; i < words.length; i++) {
    const difference = (words[i] >>> 1) ^ -(words[i] & 1);
    words[i] = (i < distance ? 0 : words[i - distance]) + difference;
  }
}
