// A module of its own, of about 250 bytes: decodes the text that scripts/inline.mjs writes into the bytes of the
// kernel. It runs once, before the kernel is compiled; JavaScript, which no engine has optimised by then, would take
// several times as long.
#include "base/simd.hpp"

extern "C" u8 __heap_base;

/// What JavaScript writes before it calls `decode`.
struct Given {
  u8 places[128];  // by character: its place in the alphabet
  u8 bytes[256];  // those that one character stands for come first
  u8 text[1];  // and more: up to the end of the memory
};

#define EXPORT(name) extern "C" __attribute__((export_name(#name))) auto name

EXPORT(given)() -> Given* { return reinterpret_cast<Given*>(&__heap_base); }

/// Decodes the text, of that many characters, in place; returns the number of bytes. The first `prefixes` of the
/// `length` characters of the alphabet begin a pair; the others stand for a byte.
EXPORT(decode)(u32 count, u32 prefixes, u32 length) -> u32 {
  Given& given = *reinterpret_cast<Given*>(&__heap_base);
  const u8* from = given.text;
  const u8* end = from + count;
  u8* to = given.text;
  while (from < end) {
    u32 at = given.places[*from++];
    if (at < prefixes) at = (at + 1) * length + given.places[*from++];
    *to++ = given.bytes[at - prefixes];
  }
  return u32(to - given.text);
}
