// Where the words of each drive lie in the image a gateway makes of its InterBus ring.
//
// No gateway's map is like another's, so it is configured and checked here before anything is sent. A drive has a
// control word and setpoint 1 (PPO 1) or setpoints 1 to 3 (PPO 2), and as many words back (BU 0070 4.2); where the
// gateway shows the word of the parameter channel (PCP), it stands before them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/register_image.h"

namespace nord_driver::interbus {

/// Positions in the ring: remote bus devices (254), of which drives are some.
constexpr unsigned kHighestPosition = 254;
constexpr std::size_t kMostValues = 3;

enum class ByteOrder : std::uint8_t { kAsIs, kSwapped };

/// The order of the values of PPO 2 on the wire.
enum class ValueOrder : std::uint8_t {
  kInOrder,         ///< SW1, SW2, SW3: SK 5xxE (BU 0070 6.1.5, the notice)
  kThreeBeforeTwo,  ///< SW1, SW3, SW2: SK 300E, 700E, 750E (BU 0070 4.2.2)
};

/// One drive as configured.
struct DriveImage {
  std::string name;
  unsigned position = 1;  ///< in the ring, 1..254
  unsigned ppo_type = 1;  ///< 1 or 2; 3 and 4 are reserved (BU 0070 4.2)
  ValueOrder value_order = ValueOrder::kInOrder;
  /// Words from the image's start, of the PCP word where there is one. None: behind the drive before it in the ring.
  std::optional<unsigned> input_offset{};
  std::optional<unsigned> output_offset{};
};

struct ImageSettings {
  std::vector<DriveImage> drives;
  bool pcp_word = false;  ///< the PCP word of each drive is part of the image
  ByteOrder byte_order = ByteOrder::kAsIs;
  unsigned input_address = 0;  ///< register of the input image's first word
  unsigned output_address = 0;
};

/// The process data of one drive: control or status word, and the values in the manual's order whatever the wire's.
struct ProcessWords {
  Word head = 0;
  std::array<Word, kMostValues> values{};
};

constexpr bool operator==(const ProcessWords& a, const ProcessWords& b) noexcept {
  return a.head == b.head && a.values[0] == b.values[0] && a.values[1] == b.values[1] && a.values[2] == b.values[2];
}

/// What a word of the input image is.
enum class WordKind : std::uint8_t { kNobodys, kPcp, kHead, kValue };
struct WordMeaning {
  WordKind kind = WordKind::kNobodys;
  std::size_t drive = 0;  ///< by its place in the settings; unless it is nobody's
  unsigned value = 0;     ///< with kValue: 1 to 3, by the manual's order
};

class ImageMap {
 public:
  /// None: `reason` is a sentence that names drive, words and what was expected.
  static std::optional<ImageMap> make(const ImageSettings& settings, std::string& reason);

  std::size_t drives() const noexcept { return drives_.size(); }
  /// Length of the images: up to the last word of a drive. The words before the first drive count, although they are
  /// neither read nor written.
  std::size_t inputWords() const noexcept { return input_words_; }
  std::size_t outputWords() const noexcept { return output_words_; }
  /// The words of one drive, by its place in the settings.
  WordRange inputs(std::size_t drive) const noexcept { return drives_[drive].inputs; }
  WordRange outputs(std::size_t drive) const noexcept { return drives_[drive].outputs; }

  /// Writes the words of one drive; the image must be `outputWords()` long. The PCP word is 0, "no parameter order".
  void put(std::size_t drive, const ProcessWords& words, RegisterImage& outputs) const noexcept;
  /// The words of one drive; all zero where the image is too short.
  ProcessWords get(std::size_t drive, const RegisterImage& inputs) const noexcept;
  /// The same of an image in which the drive has `range`, its own one of inputs() or outputs().
  ProcessWords wordsAt(WordRange range, std::size_t drive, const RegisterImage& image) const noexcept;

  /// Of input word `word`.
  WordMeaning inputMeaning(std::size_t word) const noexcept;

  /// The images in parts of at most `most` words (>= 5) and no drive in two of them: one part wherever it fits.
  std::vector<WordRange> inputParts(std::size_t most) const;
  std::vector<WordRange> outputParts(std::size_t most) const;
  /// Output words that belong to no drive and are written all the same, as 0, because they lie between two drives of
  /// one part. Whoever has other outputs there wants to know.
  std::vector<WordRange> unclaimedOutputs(std::size_t most) const;

  /// Where the control words lie in the output image, in the order of the settings.
  std::vector<std::uint16_t> controlWords() const;
  /// The bits of a control word that are all 1 in "operation enabled" (BU 2700 6.4.3 no. 4), as they lie in a
  /// register.
  Word runBits() const noexcept { return inImage(0x007F); }

 private:
  struct Place {
    WordRange inputs;
    WordRange outputs;
    ValueOrder value_order = ValueOrder::kInOrder;
    std::size_t values = 1;
  };

  ImageMap() = default;
  Word inImage(Word word) const noexcept;
  std::size_t wireIndex(const Place& place, std::size_t value) const noexcept;

  std::vector<Place> drives_;
  std::size_t input_words_ = 0;
  std::size_t output_words_ = 0;
  std::size_t pcp_words_ = 0;
  ByteOrder byte_order_ = ByteOrder::kAsIs;
};

}  // namespace nord_driver::interbus
