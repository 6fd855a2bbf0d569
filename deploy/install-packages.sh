#!/usr/bin/env bash
# Installs what deploy/apt-packages.txt lists and this machine lacks; sudo only where not root.
# Does nothing, and needs no network, where everything is there.
set -euo pipefail
cd "$(dirname "$0")"

missing=()
while read -r package unless command; do
  [ -n "$package" ] || continue
  if [ "$unless" = unless ] && command -v "$command" >/dev/null; then continue; fi
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done < <(sed -e 's/#.*//' apt-packages.txt)
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "install-packages: not root and no sudo; install by hand: ${missing[*]}" >&2; exit 1; }
  as_root=(sudo)
fi
echo "installing: ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null

# What tests start for themselves is not to run, and to listen, beside them.
if [ -d /run/systemd/system ]; then
  for service in prometheus prometheus-alertmanager victoria-metrics; do
    case " ${missing[*]} " in
      *" $service "*) "${as_root[@]}" systemctl disable --quiet --now "$service" || echo "install-packages: $service still runs" >&2 ;;
    esac
  done
fi
