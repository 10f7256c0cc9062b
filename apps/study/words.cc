#include "study/words.h"

#include "case/fields.h"
#include "errors.h"

#include <sstream>

namespace spall
{
void refuse(const Assignment &a, const std::string &allowed)
{
  throw InputError(a.location + ": " + a.section + "/" + a.key + " = " +
                   a.value + ": " + allowed);
}

std::vector<std::string> words_of(const std::string &text, char separator)
{
  std::vector<std::string> words;
  std::istringstream in(text);
  for (std::string word; std::getline(in, word, separator);)
  {
    word.erase(0, word.find_first_not_of(" \t"));
    word.erase(word.find_last_not_of(" \t") + 1);
    if (!word.empty())
      words.push_back(word);
  }
  return words;
}

std::string same_text(const std::string &value)
{
  try
  {
    return number_text(to_number(value));
  }
  catch (const std::invalid_argument &)
  {
    return value;
  }
}

std::string key_name(const Override &setting)
{
  return setting.section.empty() ? setting.key
                                 : setting.section + "/" + setting.key;
}
} // namespace spall
