#include "counted_heap.h"

#include <atomic>
#include <cstdlib>
#include <malloc.h>
#include <new>

namespace
{
std::atomic<std::int64_t> now{0}, peak{0};

void *counted(void *memory)
{
  if (!memory)
    throw std::bad_alloc();
  const auto size = static_cast<std::int64_t>(malloc_usable_size(memory));
  const std::int64_t sum = now += size;
  std::int64_t before = peak;
  while (before < sum && !peak.compare_exchange_weak(before, sum))
  {
  }
  return memory;
}

void release(void *memory)
{
  now -= static_cast<std::int64_t>(malloc_usable_size(memory));
  std::free(memory);
}
} // namespace

namespace support
{
std::int64_t heap_now()
{
  return now;
}

std::int64_t heap_peak()
{
  return peak;
}

void restart_heap_peak()
{
  peak = now.load();
}
} // namespace support

void *operator new(std::size_t size)
{
  return counted(std::malloc(size));
}

void *operator new(std::size_t size, std::align_val_t alignment)
{
  const auto unit = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(unit, (size + unit - 1) / unit * unit));
}

void operator delete(void *memory) noexcept
{
  release(memory);
}

void operator delete(void *memory, std::size_t) noexcept
{
  release(memory);
}

void operator delete(void *memory, std::align_val_t) noexcept
{
  release(memory);
}

void operator delete(void *memory, std::size_t, std::align_val_t) noexcept
{
  release(memory);
}
