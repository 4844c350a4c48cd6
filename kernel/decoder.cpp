// A module of its own, of a kilobyte: decodes the text that scripts/inline.mjs writes into bytes, and reassembles the
// kernel from the streams that scripts/streams.mjs made of it. It runs once, before the kernel is compiled. JavaScript
// would take several times as long, since no engine has optimized it by then.
#include "base/simd.hpp"

extern "C" u8 __heap_base;

namespace {

/// Written by JavaScript before it calls `decode`.
struct Given {
  u8 bytes[128];  // by character: the byte it encodes
  u8 places[128];  // by character: its place in the alphabet
  u8 pairs[256];  // by two characters: the byte they encode
  u8 text[1];  // extends to the end of the memory
};

// As in scripts/streams.mjs.
constexpr u32 streams = 10, raw = 0;
constexpr u32 longest = 4;  // bytes of an opcode
enum Head : u32 { functions, kinds, before, behind, order, lengths, numbers_in_head = lengths + streams };

/// Three bytes, the least significant first.
u32 number(const u8* at) { return at[0] | at[1] << 8 | at[2] << 16; }

/// Decodes `count` characters of text in place.
void read_text(Given& given, u32 count, u32 singles, u32 length) {
  const u8* from = given.text;
  const u8* end = from + count;
  u8* to = given.text;
  while (from < end) {
    u32 at = *from++;
    u8 byte = given.bytes[at];
    if (at < singles) byte = given.pairs[given.places[at] * length + given.places[*from++]];
    *to++ = byte;
  }
}

/// A kind of instructions.
struct Kind {
  u8 opcode[longest];
  u8 length;  // of the opcode
  u8 stream, count;  // how many numbers of the stream follow, or bytes if it is raw
  u8 more;  // the bit that says that another byte of the number follows
};

/// Writes the module that these streams encode.
void put_together(const u8* from, u8* to) {
  u32 head[numbers_in_head];
  for (u32 k = 0; k < numbers_in_head; k++, from += 3) head[k] = number(from);
  Kind known[256];
  u32 many = head[kinds];
  for (u32 k = 0; k < many; k++, from++) {
    for (u32 b = 0; b < longest; b++) known[k].opcode[b] = from[b * many];
    known[k].length = from[4 * many] >> 4;
    known[k].stream = from[4 * many] & 15;
    known[k].more = known[k].stream == raw ? 0 : 0x80;
    known[k].count = from[5 * many];
  }
  from += 5 * many;
  __builtin_memcpy(to, from, head[before]);
  to += head[before];
  const u8* next = from + head[before];
  const u8* at[streams];
  from = next + head[order];
  for (u32 s = 0; s < streams; s++) {
    at[s] = from;
    from += head[lengths + s];
  }
  for (u32 left = head[functions]; left; left--) {
    u8* begin = to + 3;  // the size is written once it is known
    u8* end = begin;
    u32 k;
    do {
      k = *next++;
      const Kind& kind = known[k];
      store(end, load<u32>(kind.opcode));
      end += kind.length;
      const u8*& given = at[kind.stream];
      for (u32 count = kind.count; count; count--) {
        u8 byte;
        do *end++ = byte = *given++;
        while (byte & kind.more);
      }
    } while (k != 0);
    u32 size = u32(end - begin);
    for (u32 rest = size; rest; rest >>= 7) *to++ = u8(rest < 0x80 ? rest : rest | 0x80);
    __builtin_memmove(to, begin, size);
    to += size;
  }
  __builtin_memcpy(to, from, head[behind]);
}

}  // namespace

#define EXPORT(name) extern "C" __attribute__((export_name(#name))) auto name

EXPORT(given)() -> Given* { return reinterpret_cast<Given*>(&__heap_base); }

/// Decodes the text, of `count` characters, and writes the module after it. The alphabet has `length` characters; those
/// with a place below `singles` begin a pair.
EXPORT(decode)(u32 count, u32 singles, u32 length) -> void {
  Given& given = *reinterpret_cast<Given*>(&__heap_base);
  read_text(given, count, singles, length);
  put_together(given.text, given.text + count);
}
