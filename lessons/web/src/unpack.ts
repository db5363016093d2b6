// Reads the columns that lessons/pack.cpp packed.
import { unzlibSync } from 'fflate';

export class Unpacker {
  private at = 0;
  private readonly bytes: Uint8Array;

  constructor(base64: string) {
    const text = atob(base64);
    const packed = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) packed[i] = text.charCodeAt(i);
    this.bytes = unzlibSync(packed);
  }

  number(): number {
    let byte = this.bytes[this.at++];
    if (byte < 0x80) return (byte >>> 1) ^ -(byte & 1);
    let value = byte & 0x7f;
    let factor = 0x80;
    do {
      byte = this.bytes[this.at++];
      value += (byte & 0x7f) * factor;
      factor *= 0x80;
    } while (byte >= 0x80);
    return value % 2 === 0 ? value / 2 : -(value + 1) / 2;
  }

  column(): Int32Array {
    const out = new Int32Array(this.number());
    let value = 0;
    for (let i = 0; i < out.length; ++i) out[i] = value += this.number();
    return out;
  }

  runs(): Int32Array {
    const out = new Int32Array(this.number());
    for (let i = 0; i < out.length; ) {
      const end = i + this.number();
      out.fill(this.number(), i, end);
      i = end;
    }
    return out;
  }
}
