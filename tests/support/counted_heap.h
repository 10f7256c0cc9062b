#pragma once

#include <cstdint>

/// What `new` has given and `delete` has not taken back: a test that links
/// counted_heap.cc counts it.
namespace support
{
std::int64_t heap_now();  ///< [bytes]
std::int64_t heap_peak(); ///< since restart_heap_peak() [bytes]
void restart_heap_peak();
} // namespace support
