#include "study/old_names.h"

#include "case/deprecated.h"
#include "case/fields.h"

namespace spall
{
namespace
{
void replace_old_names(Override &setting, const std::string &location,
                       const std::vector<Parameter> &list, Study &study)
{
  Assignment a{setting.section, setting.key, setting.value, location};
  use_present_names(a, list, study.deprecated);
  setting = {a.section, a.key, a.value};
}

} // namespace

void replace_old_names(Study &study)
{
  Case any;
  const std::vector<Parameter> list = parameters_of(any);
  for (SweptKey &swept : study.keys)
  {
    if (swept.is_variant())
      continue;
    Override setting;
    for (std::string &value : swept.values)
    {
      setting = {swept.section, swept.key, value};
      replace_old_names(setting, swept.location, list, study);
      value = setting.value;
    }
    swept.section = setting.section;
    swept.key = setting.key;
  }
  for (Override &setting : study.base)
    replace_old_names(setting, study.file, list, study);
  for (Variant &variant : study.variants)
    for (Override &setting : variant.settings)
      replace_old_names(setting, study.file, list, study);
  for (Expectation &expectation : study.expectations)
    for (std::string *name :
         {&expectation.key, &expectation.than_key, &expectation.where_key})
      if (const std::size_t slash = name->rfind('/'); slash != name->npos)
      {
        Override setting{name->substr(0, slash), name->substr(slash + 1), ""};
        replace_old_names(setting, study.file, list, study);
        *name = setting.section + "/" + setting.key;
      }
}
} // namespace spall
