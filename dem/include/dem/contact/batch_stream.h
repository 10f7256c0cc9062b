#pragma once

#include <dem/contact/batch.h>

#include <iosfwd>
#include <string>

namespace dem
{
/// Contacts bit for bit to and from a stream. Reading throws
/// std::runtime_error at the end of the stream, and where they are of a contact
/// law that is not there.
void write_batch(std::ostream &out, const ContactBatch &batch);
void read_batch(std::istream &in, ContactBatch &batch);
} // namespace dem
