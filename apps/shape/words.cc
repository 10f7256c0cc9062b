#include "shape/words.h"

#include "errors.h"
#include "shape/file.h"

#include <dem/shape/spherical_harmonics.h>

#include <charconv>
#include <map>

namespace spall
{
namespace
{
template <typename Number>
Number number(const std::string &option, const std::string &word,
              const std::string &allowed)
{
  Number value = 0;
  const char *end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || stop != end)
    throw InputError("shape: " + option + " is \"" + word + "\", must be " +
                     allowed);
  return value;
}

void require(bool is_allowed, const std::string &option,
             const std::string &word, const std::string &allowed)
{
  if (!is_allowed)
    throw InputError("shape: " + option + " is " + word + ", must be " +
                     allowed);
}

void set_order(ShapeWords &words, const std::string &word)
{
  const std::string allowed =
      "a whole number 1 .. " + std::to_string(dem::max_order);
  words.order = number<int>("--order", word, allowed);
  words.has_order = true;
  require(words.order >= 1 && words.order <= dem::max_order, "--order", word,
          allowed);
}

void set_overhang(ShapeWords &words, const std::string &word)
{
  words.fit.max_overhang = number<double>("--max-overhang", word, "0 .. 1");
  words.has_fit = true;
  require(words.fit.max_overhang >= 0. && words.fit.max_overhang <= 1.,
          "--max-overhang", word, "0 .. 1");
}

void set_misfit(ShapeWords &words, const std::string &word)
{
  words.max_misfit = number<double>("--max-misfit", word, "0 .. 1");
  words.has_fit = true;
  require(words.max_misfit >= 0. && words.max_misfit <= 1., "--max-misfit",
          word, "0 .. 1");
}

void set_patch(ShapeWords &words, const std::string &word)
{
  words.patch = number<double>("--patch", word, "0.01 .. 0.5");
  words.has_patch = true;
  require(words.patch >= 0.01 && words.patch <= 0.5, "--patch", word,
          "0.01 .. 0.5");
}

void set_samples(ShapeWords &words, const std::string &word)
{
  require(word == "rays" || word == "vertices", "--from", '"' + word + '"',
          "rays or vertices");
  words.has_fit = true;
  words.fit.samples =
      word == "rays" ? dem::FitSamples::rays : dem::FitSamples::vertices;
}

void set_unit(ShapeWords &words, const std::string &word)
{
  metres(word); // throws if unknown
  words.unit = word;
  words.has_unit = true;
}

void set_count(ShapeWords &words, const std::string &word)
{
  const std::string allowed = "a whole number 1 .. 100000";
  words.count = number<int>("--count", word, allowed);
  require(words.count >= 1 && words.count <= 100000, "--count", word, allowed);
}

void set_seed(ShapeWords &words, const std::string &word)
{
  words.seed =
      number<std::uint64_t>("--seed", word, "a whole number from 0 on");
  words.has_seed = true;
}

using Setter = void (*)(ShapeWords &, const std::string &);

const std::map<std::string, Setter> &setters()
{
  static const std::map<std::string, Setter> all = {
      {"--order", set_order},
      {"--max-overhang", set_overhang},
      {"--max-misfit", set_misfit},
      {"--from", set_samples},
      {"--patch", set_patch},
      {"--unit", set_unit},
      {"--count", set_count},
      {"--seed", set_seed},
      {"--out", [](ShapeWords &w, const std::string &word) { w.out = word; }},
      {"--json", [](ShapeWords &w, const std::string &word) { w.json = word; }},
      {"--source",
       [](ShapeWords &w, const std::string &word) { w.source = word; }},
      {"--licence",
       [](ShapeWords &w, const std::string &word) { w.licence = word; }}};
  return all;
}

Setter setter(const std::string &option)
{
  const auto found = setters().find(option);
  if (found != setters().end())
    return found->second;
  std::string names;
  for (const auto &[name, set] : setters())
    names += (names.empty() ? "" : ", ") + name;
  throw InputError("shape: " + option + " is no option: must be one of " +
                   names);
}
} // namespace

ShapeWords parse_shape_words(Words words)
{
  ShapeWords parsed;
  for (std::size_t i = 0; i < words.size(); ++i)
    if (words[i].starts_with("--"))
    {
      const Setter set = setter(words[i]);
      if (i + 1 == words.size())
        throw InputError("shape: " + words[i] + " needs a value");
      set(parsed, words[i + 1]);
      ++i;
    }
    else
      parsed.inputs.push_back(words[i]);
  return parsed;
}

void fail_shape_usage(const std::string &what)
{
  throw InputError(
      "shape: " + what +
      "needs fit MESH --order N --out S.json [--from rays|vertices] "
      "[--max-overhang F] [--max-misfit F] [--unit m|mm|um] [--json FILE] "
      "[--source TEXT] "
      "[--licence TEXT], or info S.json|MESH [--unit m|mm|um] [--json FILE], "
      "or corners MESH [S.json] --out DIR [--order N] [--patch F] "
      "[--from rays|vertices] [--max-overhang F] [--max-misfit F] "
      "[--unit m|mm|um] [--json FILE], "
      "or generate SAMPLE_DIR [SAMPLE_DIR ...] --count N --seed K --out DIR "
      "[--order N] [--json FILE]");
}
} // namespace spall
