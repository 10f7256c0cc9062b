#pragma once

#include <dem/contact/laws/dmt.h>
#include <dem/contact/laws/hertz.h>
#include <dem/contact/laws/linear.h>

#include <tuple>

namespace dem
{
/// The contact laws of the library: one entry for each. The order is that of
/// their numbers.
using ContactLaws = std::tuple<Hertz, Linear, Dmt>;
} // namespace dem
