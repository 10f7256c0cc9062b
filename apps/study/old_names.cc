#include "study/old_names.h"

#include "case/deprecated.h"
#include "case/fields.h"

namespace spall
{
namespace
{
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
      setting = {swept.section, swept.key, value, swept.location};
      use_present_names(setting, list, study.deprecated);
      value = setting.value;
    }
    swept.section = setting.section;
    swept.key = setting.key;
  }
  for (Override &setting : study.base)
    use_present_names(setting, list, study.deprecated);
  for (Variant &variant : study.variants)
    for (Override &setting : variant.settings)
      use_present_names(setting, list, study.deprecated);
  for (Expectation &expectation : study.expectations)
    for (std::string *name :
         {&expectation.key, &expectation.than_key, &expectation.where_key})
      if (const std::size_t slash = name->rfind('/'); slash != name->npos)
      {
        Override setting{name->substr(0, slash), name->substr(slash + 1), "",
                         study.file};
        use_present_names(setting, list, study.deprecated);
        *name = setting.section + "/" + setting.key;
      }
}
} // namespace spall
