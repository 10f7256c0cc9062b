#pragma once

#include <string>
#include <vector>

/// Verification: what the libraries compute beside what is known.
namespace spall::verify
{
/// One number of a case beside its reference.
struct Row
{
  std::string quantity;
  std::string unit; ///< "-" if none
  double reference = 0.;
  double computed = 0.;
  double tolerance = 0.; ///< largest error that is allowed [-]
  /// What the error is taken over, in the unit; 0: the reference itself.
  double scale = 0.;
};

/// A quantity that should be zero; its size is the error.
Row at_most(const std::string &quantity, const std::string &unit, double value,
            double limit);

/// |computed - reference| over the scale [-].
double error_of(const Row &row);
/// Within the tolerance; what is not a number is not.
bool is_held(const Row &row);

/// One scene or formula; a plain function that drives the libraries.
struct Case
{
  std::string name;
  std::string source; ///< where the references come from
  std::vector<Row> (*run)();
};

/// Cases about one subject: `spall verify NAME`, and one entry of ctest.
struct Family
{
  std::string name;
  std::string subject;
  std::vector<Case> cases;
};
} // namespace spall::verify
