// A folder with a sound input of every kind, small enough that a verb is done with it at once. A test spoils
// one thing in it and sees what the verb says.
#pragma once
#include <functional>
#include <map>
#include <string>

#include "tests/data.h"

namespace bpms::test {

class SoundFolder : public TemporaryFolder {
 public:
  SoundFolder();
};

// Every file below a folder with its content; of a folder, "/".
std::map<std::string, std::string> content_of(const TemporaryFolder& folder);

// What spoils a file of the folder.
using Edit = std::function<void(const TemporaryFolder&)>;
Edit as_it_is();
Edit replaced(const std::string& file, const std::string& what, const std::string& by);
Edit written(const std::string& file, const std::string& content);
Edit removed(const std::string& file);
Edit cut_behind(const std::string& file, const std::string& last);  // truncated: the file ends with this
Edit cut_before(const std::string& file, const std::string& first);
Edit a_folder_instead(const std::string& file);
Edit both(Edit first, Edit second);

// Photographs of a 9x6 board of 20 mm: left1.png, left2.png, ... as many as asked for.
Edit board_images(int count);
Edit blank_image(const std::string& file, int width, int height);

}  // namespace bpms::test
