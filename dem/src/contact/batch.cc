#include <dem/contact/batch.h>

namespace dem
{
void ContactBatch::resize(std::size_t n)
{
  a.resize(n);
  b.resize(n);
  side_a.resize(n);
  side_b.resize(n);
  prefactors.resize(n);
  wake.resize(n);
  twist.resize(n);
  history.resize(n);
  lost.resize(n);
  load.resize(n);
  normal.resize(n, Vec3::UnitX());
  event.resize(n);
}

void ContactBatch::copy_entry(std::size_t to, const ContactBatch &other,
                              std::size_t from)
{
  a[to] = other.a[from];
  b[to] = other.b[from];
  side_a[to] = other.side_a[from];
  side_b[to] = other.side_b[from];
  prefactors[to] = other.prefactors[from];
  wake[to] = other.wake[from];
  twist[to] = other.twist[from];
  history[to] = other.history[from];
  lost[to] = other.lost[from];
  load[to] = other.load[from];
  normal[to] = other.normal[from];
  event[to] = other.event[from];
}
} // namespace dem
