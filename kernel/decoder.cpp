// A module of its own, of a kilobyte: puts the streams that scripts/streams.mjs has made of the kernel together again, out
// of the text in which scripts/inline.mjs has written them. It runs once, before the kernel is compiled; JavaScript, which
// no engine has optimised by then, would take several times as long. Nor is this code optimised by then: so it reads the
// text where it stands, in one pass.
#include "base/simd.hpp"

extern "C" u8 __heap_base;

namespace {

// The alphabet of scripts/inline.mjs: these characters, but those that mean something in strings and in HTML.
constexpr u8 first = 33, end = 127;
constexpr u8 first_single = '(';  // those before it begin a pair
constexpr u32 letters = 87;
bool has_meaning(u8 character) {
  for (char one : "'\"`\\$<&")
    if (one == character) return true;
  return false;
}

// By character: its place in the alphabet, the byte that it stands for, and whether more belongs to it: the second of a
// pair, or another byte of the same number.
u8 places[end], bytes[end], more[end];
constexpr u8 more_bit = 0x80;
u8 rare[256];  // in ascending order, the bytes that no character stands for alone

[[gnu::noinline]] u8 pair_at(const u8* at) { return places[at[0]] * letters + places[at[1]]; }

[[gnu::always_inline]] u8 read(const u8*& from) {
  u8 character = *from++;
  return character < first_single ? rare[pair_at(from++ - 1)] : bytes[character];
}
[[gnu::noinline]] u8 read_one(const u8*& from) { return read(from); }

/// Three bytes, the least significant first.
u32 read_number(const u8*& from) {
  u32 low = read_one(from), middle = read_one(from);
  return low | middle << 8 | read_one(from) << 16;
}

u8* copy(const u8* from, const u8* end, u8* to) {
  while (from < end) *to++ = read_one(from);
  return to;
}

/// A text begins with the bytes that stand as one character each.
void read_alphabet(const u8*& from) {
  u8 place = 0;
  for (u8 c = first; c < end; c++)
    if (!has_meaning(c)) places[c] = place++;
  static bool alone[256];
  for (u8 c = first; c < end; c++) {
    more[c] = more_bit;
    if (has_meaning(c) || c < first_single) continue;
    u8 byte = pair_at(from);
    from += 2;
    bytes[c] = byte;
    more[c] = byte & more_bit;
    alone[byte] = true;
  }
  u8* next = rare;
  for (u32 byte = 0; byte < 256; byte++)
    if (!alone[byte]) *next++ = u8(byte);
}

// As in scripts/streams.mjs.
constexpr u32 streams = 11, of_kinds = 0, raw = 1;
constexpr u32 longest = 4;  // bytes of an opcode
constexpr u8 trap[] = {0, 0, 0x0b};  // a function without locals, whose only instruction is `unreachable`
constexpr u32 owners[] = {0, 2, 3};  // functions are for both dimensions, or for one
enum Head : u32 { functions, kinds, before, owned, behind, lengths, numbers_in_head = lengths + 3 * streams };

/// A kind of instructions.
struct Kind {
  u8 opcode[longest];
  u8 length;  // of the opcode
  u8 stream, count;  // how many of its numbers follow, or bytes if it is raw
  u8 more;  // where one number follows, the bit that says that more belongs to its first byte; else 0
};
Kind known[256];

void read_kinds(const u8*& from, u32 many) {
  for (u32 b = 0; b < longest; b++)
    for (u32 k = 0; k < many; k++) known[k].opcode[b] = read_one(from);
  for (u32 k = 0; k < many; k++) {
    u8 form = read_one(from);
    known[k].length = form >> 4;
    known[k].stream = form & 15;
  }
  for (u32 k = 0; k < many; k++) {
    known[k].count = read_one(from);
    known[k].more = known[k].count == 1 ? more_bit : 0;
  }
}

u8* write_number(u8* to, u32 value) {
  for (; value >= 0x80; value >>= 7) *to++ = u8(value | 0x80);
  *to++ = u8(value);
  return to;
}

/// Writes how many bytes stand behind a gap, and moves them into it; returns where they end then.
u8* close(u8* to, const u8* begin, const u8* end) {
  u32 size = u32(end - begin);
  to = write_number(to, size);
  __builtin_memmove(to, begin, size);
  return to + size;
}
constexpr u32 gap = 5;

/// Writes one function; returns its end. `at`: where each stream is read. Out of line: V8 begins to optimise the function
/// that loops, on another thread, and a small one takes it a quarter of the time.
[[gnu::noinline]] u8* write_function(const u8** at, u8* to) {
  const u8* next = at[of_kinds];
  u32 k;
  do {
    k = read(next);
    const Kind& kind = known[k];
    store(to, load<u32>(kind.opcode));
    to += kind.length;
    const u8*& given = at[kind.stream];
    u8 character = *given;
    if (kind.count <= 1 && !(more[character] & kind.more)) {
      *to = bytes[character];
      given += kind.count;
      to += kind.count;
      continue;
    }
    u8 bit = kind.stream == raw ? 0 : more_bit, byte;
    for (u32 count = kind.count; count; count--) {
      do *to++ = byte = read(given);
      while (byte & bit);
    }
  } while (k != 0);
  at[of_kinds] = next;
  return to;
}

/// Writes the module that a text stands for; what is only for `unused` dimensions is not in the text, and does nothing.
/// Returns its end.
u8* put_together(const u8* from, u8* to, u32 unused) {
  read_alphabet(from);
  u32 head[numbers_in_head];
  for (u32& one : head) one = read_number(from);
  read_kinds(from, head[kinds]);
  to = copy(from, from + head[before], to);
  const u8* owner = from += head[before];
  const u8* last_part = from += head[owned];
  from += head[behind];
  static const u8* at[4][streams];  // by owner
  const u32* length = head + lengths;
  for (u32 one : owners) {
    for (u32 s = 0; s < streams; s++, length++) {
      at[one][s] = from;
      if (one == 0 || one != unused) from += *length;
    }
  }
  u8* section = to + gap;
  u8* last = write_number(section, head[functions]);
  for (u32 left = head[functions]; left; left--) {
    u32 one = read_one(owner);
    u8* begin = last + gap;
    u8* end = begin + sizeof trap;
    if (one && one == unused) __builtin_memcpy(begin, trap, sizeof trap);
    else end = write_function(at[one], begin);
    last = close(last, begin, end);
  }
  to = close(to, section, last);
  return copy(last_part, last_part + head[behind], to);
}

}  // namespace

#define EXPORT(name) extern "C" __attribute__((export_name(#name))) auto name

/// Decodes the text, of that many characters, which begins at `__heap_base`; returns how many bytes the module has, which
/// begins behind it. What is only for `unused` dimensions is not in the text, and becomes traps.
EXPORT(decode)(u32 characters, u32 unused) -> u32 {
  u8* text = &__heap_base;
  u8* module = text + characters;
  return u32(put_together(text, module, unused) - module);
}
