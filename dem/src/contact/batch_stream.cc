#include <dem/binary.h>
#include <dem/contact/batch_stream.h>

#include <stdexcept>

namespace dem
{
namespace
{
template <class Batch, class Visit>
void visit_batch(Batch &batch, const Visit &visit)
{
  ContactBatch::visit(
      batch.layout, [&visit](bool, auto &column) { visit(column); }, batch);
}

/// One by one: between the fields of the struct there may be anything.
template <class Layout, class Visit>
void visit_layout(Layout &layout, const Visit &visit)
{
  visit(layout.law.law);
  visit(layout.law.values);
  visit(layout.has_attraction);
  visit(layout.has_prefactors);
  visit(layout.has_rolling);
  visit(layout.has_sides);
  visit(layout.has_partners);
  visit(layout.has_damage);
  visit(layout.has_reversal);
  visit(layout.has_peak);
  visit(layout.has_contact_points);
}
} // namespace

void write_batch(std::ostream &out, const ContactBatch &batch)
{
  visit_layout(batch.layout,
               [&out](const auto &field) { write_value(out, field); });
  write_value(out, batch.size());
  visit_batch(batch, [&out](const auto &column) { write_column(out, column); });
}

void read_batch(std::istream &in, ContactBatch &batch)
{
  visit_layout(batch.layout, [&in](auto &field) { read_value(in, field); });
  const auto n_laws = static_cast<std::int32_t>(contact_laws().size());
  if (batch.layout.law.law < 0 || batch.layout.law.law >= n_laws)
    throw std::runtime_error("checkpoint: a contact law that is not there");
  std::size_t n = 0;
  read_value(in, n);
  batch.set_size(n);
  visit_batch(batch, [&in](auto &column) { read_column(in, column); });
}
} // namespace dem
