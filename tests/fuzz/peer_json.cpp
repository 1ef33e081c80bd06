// What other renderers print of their runs.
#include "fuzz/input.h"
#include "report/study/peer.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace lancer;
    const std::string text(fuzz::as_text(data, size));
    fuzz::reads([&] { read_peer_about("peer", text); });
    fuzz::reads([&] { read_peer_records("peer", text, {4, 16}); });
    return 0;
}
