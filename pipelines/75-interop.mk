# Readers of the tools' files that are not ours, and ours in other languages: which agree with the tools, and
# which were not installed. Writes to out/interop.
.PHONY: interop
interop: $(BINARIES)
	@pipelines/interop/check.sh $(BIN) out/interop
