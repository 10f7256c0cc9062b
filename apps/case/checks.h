#pragma once

#include "case/case.h"
#include "specimen/gradation.h"

#include <string>

namespace spall
{
/// One refusal: section, key and value as given, and what is allowed.
struct Fault
{
  std::string section, key, value, allowed;
};

/// Throws InputError with the location.
[[noreturn]] void refuse(const SourceLocation &location, const Fault &fault);

/// The table that the key `gradation` of a section names.
Gradation check_gradation(const Case &c, const SourceLocation &location,
                          const std::string &section, const std::string &file);
/// A folder of shapes, or none.
void check_shapes(const Case &c, const SourceLocation &location,
                  const std::string &section, const std::string &shapes);
/// With Coupling/exchange = every_step nothing has steps of its own.
void check_every_step(const Case &c, const SourceLocation &location);
/// Windows that adapt are refused.
void check_equal_windows(const Case &c, const SourceLocation &location);
/// Of a test with a membrane, which the case has chosen by `choice`, such as
/// "Boundary/lateral = membrane": its exchange must be chosen, too.
void check_membrane(const Case &c, const SourceLocation &location,
                    const std::string &choice);
/// The stiffness of contacts goes into implicit steps of a membrane alone.
void check_contact_tangent(const Case &c, const SourceLocation &location,
                           bool has_membrane);
/// Particles turn with one inertia where they meet: that of spheres, or their
/// own.
void check_inertia(const Case &c, const SourceLocation &location);
/// Time/step = error is refused.
void check_no_step_error(const Case &c, const SourceLocation &location);

/// A wall that moves, or is moved by forces, is refused: `allowed` is the
/// reason.
void check_at_rest(const Case &c, const SourceLocation &location,
                   const WallSection &wall, const std::string &allowed);

/// Checks beyond single ranges: parameters against each other and against
/// the files they name. Throws InputError.
void check_case(const Case &parameters, const SourceLocation &location);
} // namespace spall
