#include "common/io/stream_start.h"

#include "common/io/aedat2_decoder.h"
#include "common/io/dat_decoder.h"
#include "common/io/es_decoder.h"
#include "common/io/event_file_kind.h"
#include "common/io/raw_start.h"
#include "common/io/text_decoder.h"

namespace puck {

std::optional<StreamStart> find_stream_start(const StreamHead& head) {
  const auto kind = event_file_kind(head.name, head.text(), head.is_all, head.options.from);
  if (!kind) return std::nullopt;
  switch (*kind) {
    case EventFileKind::kRaw:
      return begin_raw(head);
    case EventFileKind::kDat:
      return begin_dat(head);
    case EventFileKind::kAedat2:
      return begin_aedat2(head);
    case EventFileKind::kEventStream:
      return begin_es(head);
    case EventFileKind::kText:
      return begin_text(head);
    default:
      throw EventFileError(head.name + ": is " + name_of(*kind) +
                           ", which cannot be read from a live stream; expected Prophesee RAW or "
                           "DAT, Event Stream, AEDAT 2.0 or text, or a recording: camera.source = "
                           "\"file\" with camera.file = \"-\" reads one from stdin");
  }
}

}  // namespace puck
