#include "study/judge.h"

#include "report/text.h"

#include <algorithm>
#include <cmath>
#include <optional>

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
    text +=
        (text.empty() ? "" : ", ") + level.value + ": " +
        format(level.mean(), 4) +
        (level.samples.size() < 2 ? "" : " ± " + format(level.deviation(), 2));
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

/// Of a statement with two parts.
Ruling both(Ruling one, Ruling other)
{
  if (one == Ruling::does_not || other == Ruling::does_not)
    return Ruling::does_not;
  return one == Ruling::holds ? other : one;
}

/// All data of a comparison by seeds.
struct Evidence
{
  const StudyData &data;
  Cut cut;
  std::size_t outcome;
  std::vector<Level> levels;

  SeedValues differences(std::size_t from, std::size_t to) const
  {
    return paired_differences(data, cut, outcome, levels[from].value,
                              levels[to].value);
  }
  Estimate difference(std::size_t from, std::size_t to) const
  {
    return estimate_of(differences(from, to));
  }
  SeedValues whole() const { return differences(0, levels.size() - 1); }
};

/// Some levels in a row.
struct Stretch
{
  std::size_t first, last;
};

Evidence evidence_of(const StudyData &data, const Expectation &expected,
                     const std::string &key, const std::string &where_key,
                     const std::string &where_value)
{
  Cut cut(index_of(data.study, key));
  if (!where_key.empty())
  {
    cut.where_key = index_of(data.study, where_key);
    cut.where_value = where_value;
  }
  const auto outcome = static_cast<std::size_t>(
      std::ranges::find(data.study.outcomes, expected.outcome) -
      data.study.outcomes.begin());
  return {data, cut, outcome, levels_of(data, cut, outcome)};
}

Evidence evidence_of(const StudyData &data, const Expectation &expected)
{
  return evidence_of(data, expected, expected.key, expected.where_key,
                     expected.where_value);
}

/// What answers_more compares with.
Evidence other_evidence(const StudyData &data, const Expectation &expected)
{
  if (expected.than_value.empty())
    return evidence_of(data, expected, expected.than_key, expected.where_key,
                       expected.where_value);
  return evidence_of(data, expected, expected.key, expected.than_key,
                     expected.than_value);
}

/// Whether a change is certainly less than what is noticeable.
bool is_small(const Evidence &seen, const Estimate &change)
{
  const double limit = noticeable * std::abs(mean_of(seen.levels));
  return change.is_below(limit) && change.is_above(-limit);
}

/// Up for sign 1, down for -1; a step the other way speaks against it unless
/// it is small: of many steps some are resolved by chance.
Verdict judge_way(const Evidence &seen, const Stretch &over, double sign)
{
  const Estimate whole = seen.difference(over.first, over.last);
  const double scale = std::abs(seen.levels[over.first].mean());
  Verdict verdict{Ruling::not_resolved, "; change " + in_words(whole, scale)};
  const auto goes = [sign](const Estimate &e, double way)
  { return e.is_resolved() && way * sign * e.mean > 0.; };
  if (goes(whole, -1.))
    verdict.ruling = Ruling::does_not;
  else if (goes(whole, 1.))
    verdict.ruling = Ruling::holds;
  else if (is_small(seen, whole))
    verdict.ruling = Ruling::unchanged;
  for (std::size_t l = over.first + 1; l <= over.last; ++l)
    if (const Estimate step = seen.difference(l - 1, l);
        goes(step, -1.) && !is_small(seen, step))
      verdict.ruling = Ruling::does_not;
  return verdict;
}

/// Whether the whole change is this share of the first value.
Ruling judge_share(const Evidence &seen, const Expectation &expected,
                   double sign)
{
  SeedValues shares = seen.whole();
  for (auto &[seed, share] : shares)
    share *= sign / std::abs(seen.levels.front().mean());
  const Estimate e = estimate_of(shares);
  if (e.is_below(expected.share_low) || e.is_above(expected.share_high))
    return Ruling::does_not;
  return e.is_above(expected.share_low) && e.is_below(expected.share_high)
             ? Ruling::holds
             : Ruling::not_resolved;
}

/// Whether the outcome answers more to a step of the key beyond this level.
Verdict judge_bend(const Evidence &seen, std::size_t middle, double sign)
{
  const std::size_t last = seen.levels.size() - 1;
  const auto slopes = [&](std::size_t from, std::size_t to)
  {
    SeedValues all = seen.differences(from, to);
    for (auto &[seed, one] : all)
      one /= seen.levels[to].x - seen.levels[from].x;
    return all;
  };
  const Estimate e =
      estimate_of(combined(slopes(middle, last), slopes(0, middle),
                           [sign](double beyond, double before)
                           { return sign * (beyond - before); }));
  return {!e.is_resolved() ? Ruling::not_resolved : ruled(e.mean > 0.),
          "; steeper by " + in_words(e, 0.) + " per unit"};
}

/// Whether differences to the first of these levels are below or above what is
/// noticeable.
Verdict judge_sameness(const Evidence &seen, const Stretch &over)
{
  const double limit = noticeable * std::abs(mean_of(seen.levels));
  bool are_all_small = true, is_one_large = false;
  std::string numbers;
  for (std::size_t l = over.first + 1; l <= over.last; ++l)
  {
    const Estimate e = seen.difference(over.first, l);
    are_all_small &= is_small(seen, e);
    is_one_large |= e.is_above(limit) || e.is_below(-limit);
    numbers += "; " + seen.levels[l].value + " less " +
               seen.levels[over.first].value + " " +
               in_words(e, std::abs(seen.levels[over.first].mean()));
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
  const SeedValues a = one.whole(), b = other.whole();
  const Estimate e = estimate_of(combined(
      a, b, [](double x, double y) { return std::abs(x) - std::abs(y); }));
  return {!e.is_resolved() ? Ruling::not_resolved : ruled(e.mean > 0.),
          "; change " + in_words(estimate_of(a), 0.) + " against " +
              in_words(estimate_of(b), 0.)};
}

/// Index of the level from which a rise or fall changes; none where
/// it is no inner one.
std::optional<std::size_t> turn_of(const std::vector<Level> &levels,
                                   const Expectation &expected)
{
  const auto found =
      std::ranges::find(levels, expected.course_value, &Level::value);
  if (levels.empty() || found == levels.begin() || found >= levels.end() - 1)
    return {};
  return static_cast<std::size_t>(found - levels.begin());
}

Verdict judge_course(const Evidence &seen, const Expectation &expected)
{
  const double sign = expected.relation == "rises" ? 1. : -1.;
  const std::size_t last = seen.levels.size() - 1;
  if (expected.course == Course::plain)
    return judge_way(seen, {0, last}, sign);
  const std::optional<std::size_t> turn = turn_of(seen.levels, expected);
  if (!turn)
    return {};
  Verdict before, beyond;
  if (expected.course == Course::steeper_from)
  {
    before = judge_way(seen, {0, last}, sign);
    beyond = judge_bend(seen, *turn, sign);
  }
  else
  {
    before = judge_way(seen, {0, *turn}, sign);
    beyond = expected.course == Course::level_from
                 ? judge_sameness(seen, {*turn, last})
                 : judge_way(seen, {*turn, last}, -sign);
  }
  return {both(before.ruling, beyond.ruling), before.numbers + beyond.numbers};
}

Verdict judge_seeds(const StudyData &data, const Expectation &expected)
{
  const Evidence seen = evidence_of(data, expected);
  const std::size_t n = seen.levels.size();
  const std::string &relation = expected.relation;
  Verdict verdict;
  if (relation == "is_positive" || relation == "is_negative")
    verdict = judge_sign(seen, relation == "is_positive" ? 1. : -1.);
  else if (n < 2)
    return {Ruling::not_resolved, "", numbers_of(seen.levels)};
  else if (relation == "answers_more")
  {
    const Evidence other = other_evidence(data, expected);
    if (other.levels.size() > 1)
      verdict = judge_answers(seen, other);
  }
  else if (relation == "rises" || relation == "falls")
  {
    verdict = judge_course(seen, expected);
    if (expected.has_share)
      verdict.ruling =
          both(verdict.ruling,
               judge_share(seen, expected, relation == "rises" ? 1. : -1.));
  }
  else if (relation == "settles_low")
    verdict = judge_sameness(seen, {0, 1});
  else if (relation == "settles_high")
    verdict = judge_sameness(seen, {n - 2, n - 1});
  else
  {
    verdict = judge_sameness(seen, {0, n - 1});
    if (expected.has_share)
      verdict.ruling = both(verdict.ruling, judge_share(seen, expected, 1.));
    if (relation == "changes" && verdict.ruling != Ruling::not_resolved)
      verdict.ruling = ruled(verdict.ruling == Ruling::does_not);
  }
  verdict.levels = numbers_of(seen.levels);
  return verdict;
}

/// By means, where a rise or fall changes from a level on.
Ruling judge_turn(const std::vector<Level> &levels, const Expectation &expected)
{
  const std::optional<std::size_t> turn = turn_of(levels, expected);
  if (!turn)
    return Ruling::does_not;
  const auto at = levels.begin() + static_cast<std::ptrdiff_t>(*turn);
  const std::string &way = expected.relation;
  if (expected.course == Course::steeper_from)
  {
    const auto slope = [](const Level &from, const Level &to)
    { return (to.mean() - from.mean()) / (to.x - from.x); };
    const double bend = slope(*at, levels.back()) - slope(levels.front(), *at);
    return both(judge_means(levels, way).ruling,
                ruled((way == "rises" ? 1. : -1.) * bend > 0.));
  }
  const std::string beyond = expected.course == Course::level_from ? "stays"
                             : way == "rises"                      ? "falls"
                                                                   : "rises";
  return both(judge_means({levels.begin(), at + 1}, way).ruling,
              judge_means({at, levels.end()}, beyond).ruling);
}
} // namespace

Verdict judge_means(const std::vector<Level> &levels,
                    const std::string &relation)
{
  Verdict verdict{Ruling::does_not, "", numbers_of(levels)};
  std::vector<double> means;
  for (const Level &level : levels)
    means.push_back(level.mean());
  // Where some level gave nothing, nothing is shown.
  if (means.empty() || !std::ranges::all_of(means, [](double mean)
                                            { return std::isfinite(mean); }))
    return verdict;
  const auto [low, high] = std::ranges::minmax(means);
  const bool is_sign = relation == "is_positive" || relation == "is_negative";
  if (is_sign)
    verdict.ruling = ruled(relation == "is_positive" ? low > 0. : high < 0.);
  const std::size_t n = means.size();
  if (n < 2 && !is_sign) // there is nothing to compare
    verdict.ruling = Ruling::not_resolved;
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
  const std::vector<Level> levels = evidence_of(data, expected).levels;
  Verdict verdict = judge_means(levels, expected.relation);
  const auto change = [](const std::vector<Level> &of)
  { return of.empty() ? 0. : of.back().mean() - of.front().mean(); };
  if (expected.course != Course::plain)
    verdict.ruling = judge_turn(levels, expected);
  if (expected.has_share && !levels.empty())
  {
    const double share = (expected.relation == "falls" ? -1. : 1.) *
                         change(levels) / std::abs(levels.front().mean());
    verdict.ruling = both(verdict.ruling, ruled(share > expected.share_low &&
                                                share < expected.share_high));
  }
  if (expected.relation == "answers_more")
  {
    const std::vector<Level> other = other_evidence(data, expected).levels;
    verdict.ruling = ruled(std::abs(change(levels)) > std::abs(change(other)));
    verdict.numbers += " against " + numbers_of(other);
  }
  return verdict;
}
} // namespace spall
