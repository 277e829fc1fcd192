# Sweeps: a table of parameters, a row a run (docs/cluster.md).

# make sweep SWEEP=table.csv [SWEEP_CASE=case.toml] [RESPONSE=max_depth_um]
# Starting it again goes on where it was stopped; rows added to the table are added to the results.
RESPONSE ?= entered_share
.PHONY: sweep
sweep: $(BINARIES)
	@pipelines/told.sh pipelines/sweep/local.sh $(call q,$(SWEEP)) $(call q,$(or $(SWEEP_CASE),pipelines/cases/pf-implicit.toml)) "$(RESPONSE)" $(AT_ONCE)

# The same small sweep by every engine that is installed here, with jobs killed on the way: which were
# found, and whether their tables are the same byte for byte. Writes to out/engines.
.PHONY: engines
engines: $(BINARIES)
	@pipelines/sweep/engines.sh $(BIN) out/engines
