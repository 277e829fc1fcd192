# The gate: what a change is attacked with. The numbers are in docs/results/reliability.md.

# Advisories, licences and sources of the dependencies; says what it could not check.
.PHONY: deny
deny:
	@pipelines/gate/deny.sh
