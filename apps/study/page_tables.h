#pragma once

#include "report/text_table.h"
#include "study/study.h"

namespace spall
{
/// A table that stands beside a page as a file.
struct PageFile
{
  std::string words; ///< of the link
  std::string name;  ///< begins with the stem of the page
  std::string text;  ///< comma-separated
};

/// The full tables of a study: expectations with all means, errors against the
/// base case, differences of every value from the first one. `stem` is the name
/// of the page without its ending. Tables without rows are left out.
std::vector<PageFile> page_files(const StudyData &data,
                                 const std::string &stem);

/// The short tables of a study in Markdown, with links to the files.
std::string study_markdown(const StudyData &data, const std::string &stem);
} // namespace spall
