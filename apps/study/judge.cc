#include "study/judge.h"

#include "report/text.h"

#include <algorithm>
#include <cmath>

namespace spall
{
namespace
{
/// Differences of means below this share of the mean of all are none.
constexpr double noticeable = 0.05;

std::string numbers_of(const std::vector<Level> &levels)
{
  std::string text;
  for (const Level &level : levels)
    text += (text.empty() ? "" : ", ") + level.value + ": " +
            format(level.mean(), 4);
  return text;
}

double mean_of(const std::vector<Level> &levels)
{
  double sum = 0.;
  for (const Level &level : levels)
    sum += level.mean();
  return sum / static_cast<double>(levels.size());
}

Ruling ruled(bool holds)
{
  return holds ? Ruling::holds : Ruling::does_not;
}

/// Everything that judging by seeds looks at.
struct Evidence
{
  const StudyData &data;
  Cut cut;
  std::size_t outcome;
  std::vector<Level> levels;

  Estimate difference(std::size_t from, std::size_t to) const
  {
    return estimate_of(paired_differences(
        data, cut, outcome, levels[from].value, levels[to].value));
  }
  Estimate whole() const { return difference(0, levels.size() - 1); }
};

Evidence evidence_of(const StudyData &data, const Expectation &expected,
                     const std::string &key)
{
  Cut cut(place_of(data.study, key));
  if (!expected.where_key.empty())
  {
    cut.where_key = place_of(data.study, expected.where_key);
    cut.where_value = expected.where_value;
  }
  const auto outcome = static_cast<std::size_t>(
      std::ranges::find(data.study.outcomes, expected.outcome) -
      data.study.outcomes.begin());
  return {data, cut, outcome, levels_of(data, cut, outcome)};
}

/// Up for sign 1, down for -1; a step the other way speaks against it.
Verdict judge_way(const Evidence &seen, double sign)
{
  const Estimate whole = seen.whole();
  const double scale = std::abs(seen.levels.front().mean());
  Verdict verdict{Ruling::not_resolved, "; change " + in_words(whole, scale)};
  const auto goes = [sign](const Estimate &e, double way)
  { return e.is_resolved() && way * sign * e.mean > 0.; };
  if (goes(whole, -1.))
    verdict.ruling = Ruling::does_not;
  else if (goes(whole, 1.))
    verdict.ruling = Ruling::holds;
  for (std::size_t l = 1; l < seen.levels.size(); ++l)
    if (goes(seen.difference(l - 1, l), -1.))
      verdict.ruling = Ruling::does_not;
  return verdict;
}

/// Whether differences to the first of these levels are below or above what is
/// noticeable.
Verdict judge_sameness(const Evidence &seen, std::size_t first,
                       std::size_t last)
{
  const double limit = noticeable * std::abs(mean_of(seen.levels));
  bool are_all_small = true, is_one_large = false;
  std::string numbers;
  for (std::size_t l = first + 1; l <= last; ++l)
  {
    const Estimate e = seen.difference(first, l);
    are_all_small &= e.is_below(limit) && e.is_above(-limit);
    is_one_large |= e.is_above(limit) || e.is_below(-limit);
    numbers += "; " + seen.levels[l].value + " less " +
               seen.levels[first].value + " " +
               in_words(e, std::abs(seen.levels[first].mean()));
  }
  return {are_all_small  ? Ruling::holds
          : is_one_large ? Ruling::does_not
                         : Ruling::not_resolved,
          numbers};
}

Verdict judge_sign(const Evidence &seen, double sign)
{
  const Estimate e = estimate_of(seed_means(seen.data, seen.cut, seen.outcome));
  return {!e.is_resolved() ? Ruling::not_resolved : ruled(sign * e.mean > 0.),
          "; mean " + in_words(e, 0.)};
}

Verdict judge_answers(const Evidence &one, const Evidence &other)
{
  const auto changes = [](const Evidence &seen)
  {
    return paired_differences(seen.data, seen.cut, seen.outcome,
                              seen.levels.front().value,
                              seen.levels.back().value);
  };
  const std::vector<double> a = changes(one), b = changes(other);
  if (a.size() != b.size())
    return {};
  std::vector<double> more;
  for (std::size_t s = 0; s < a.size(); ++s)
    more.push_back(std::abs(a[s]) - std::abs(b[s]));
  const Estimate e = estimate_of(more);
  return {!e.is_resolved() ? Ruling::not_resolved : ruled(e.mean > 0.),
          "; change " + in_words(estimate_of(a), 0.) + " against " +
              in_words(estimate_of(b), 0.)};
}

Verdict judge_seeds(const StudyData &data, const Expectation &expected)
{
  const Evidence seen = evidence_of(data, expected, expected.key);
  const std::size_t n = seen.levels.size();
  const std::string &relation = expected.relation;
  Verdict verdict;
  if (relation == "is_positive" || relation == "is_negative")
    verdict = judge_sign(seen, relation == "is_positive" ? 1. : -1.);
  else if (n < 2)
    return {Ruling::not_resolved, numbers_of(seen.levels)};
  else if (relation == "answers_more")
  {
    const Evidence other = evidence_of(data, expected, expected.than);
    if (other.levels.size() > 1)
      verdict = judge_answers(seen, other);
  }
  else if (relation == "rises" || relation == "falls")
    verdict = judge_way(seen, relation == "rises" ? 1. : -1.);
  else if (relation == "settles_low")
    verdict = judge_sameness(seen, 0, 1);
  else if (relation == "settles_high")
    verdict = judge_sameness(seen, n - 2, n - 1);
  else
  {
    verdict = judge_sameness(seen, 0, n - 1);
    if (relation == "changes" && verdict.ruling != Ruling::not_resolved)
      verdict.ruling = ruled(verdict.ruling == Ruling::does_not);
  }
  verdict.numbers = numbers_of(seen.levels) + verdict.numbers;
  return verdict;
}
} // namespace

Verdict judge_means(const std::vector<Level> &levels,
                    const std::string &relation)
{
  Verdict verdict{Ruling::does_not, numbers_of(levels)};
  std::vector<double> means;
  for (const Level &level : levels)
    means.push_back(level.mean());
  // Where some level gave nothing, nothing is shown.
  if (means.empty() || !std::ranges::all_of(means, [](double mean)
                                            { return std::isfinite(mean); }))
    return verdict;
  const auto [low, high] = std::ranges::minmax(means);
  if (relation == "is_positive" || relation == "is_negative")
    verdict.ruling = ruled(relation == "is_positive" ? low > 0. : high < 0.);
  const std::size_t n = means.size();
  if (n < 2)
    return verdict;
  const double limit = noticeable * std::abs(mean_of(levels));
  const double sign = relation == "falls" ? -1. : 1.;
  bool is_one_way = sign * (means.back() - means.front()) > limit;
  for (std::size_t l = 1; l < n; ++l)
    is_one_way = is_one_way && sign * (means[l] - means[l - 1]) >= -limit;
  if (relation == "rises" || relation == "falls")
    verdict.ruling = ruled(is_one_way);
  else if (relation == "changes")
    verdict.ruling = ruled(high - low > limit);
  else if (relation == "stays")
    verdict.ruling = ruled(high - low <= limit);
  else if (relation == "settles_low")
    verdict.ruling = ruled(std::abs(means[1] - means[0]) <= limit);
  else if (relation == "settles_high")
    verdict.ruling = ruled(std::abs(means[n - 1] - means[n - 2]) <= limit);
  return verdict;
}

Verdict judge(const StudyData &data, const Expectation &expected)
{
  if (data.study.judged_by == JudgedBy::seeds)
    return judge_seeds(data, expected);
  const Evidence seen = evidence_of(data, expected, expected.key);
  Verdict verdict = judge_means(seen.levels, expected.relation);
  if (expected.relation == "answers_more")
  {
    const Evidence other = evidence_of(data, expected, expected.than);
    const auto change = [](const std::vector<Level> &levels)
    {
      return levels.empty()
                 ? 0.
                 : std::abs(levels.back().mean() - levels.front().mean());
    };
    verdict.ruling = ruled(change(seen.levels) > change(other.levels));
    verdict.numbers += " against " + numbers_of(other.levels);
  }
  return verdict;
}
} // namespace spall
