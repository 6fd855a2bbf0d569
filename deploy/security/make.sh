#!/usr/bin/env bash
# Makes what DDS Security asks for: a TEST certificate authority, and for each program a folder with its key, its certificate and
# what it may do. For the bench and for a first look: whoever has the folder `ca` can let anybody in. docs/security.md tells more.
#
#   bash deploy/security/make.sh FOLDER                       programs gyrod (role daemon), sensor and reader
#   bash deploy/security/make.sh FOLDER --program imu1=sensor --program cockpit=reader
#
#   --program NAME=ROLE  this program, not those three; a role is a file permissions-ROLE.xml of the templates: daemon, sensor, reader
#   --domain N, N-M      DDS domains that they may join [0-230]
#   --days N             the certificates and permissions of the programs hold so long [365]
#   --ca-days N          that of the authority, where there is none yet [3650]
#   --templates FOLDER   governance.xml and permissions-*.xml [those beside this script]
#   --revoke NAME        makes nothing new: puts the program's certificate on the list crl.pem in all other programs' folders
#   --renew              new certificates for the keys that are there
#   --force              throws the authority and these programs' keys away; what it has signed for others holds no more
#
# Keys that exist are kept, and so are their certificates; governance and permissions are signed anew each time. Each program's
# folder has the layout of a ROS 2 (SROS2) enclave: point "bus.security.folder", or gyrod --security, at it.
set -euo pipefail
umask 077
here=$(cd "$(dirname "$0")" && pwd)

fail() { echo "make.sh: $*" >&2; exit 2; }
usage() { sed -n '2,/^[^#]/s/^# \{0,1\}//p' "$0"; }

folder='' domains=0-230 days=365 ca_days=3650 templates=$here/templates revoked='' renew=false force=false
programs=()
while [ $# -gt 0 ]; do
  case "$1" in
    --program | --domain | --days | --ca-days | --templates | --revoke)
      [ $# -gt 1 ] || fail "$1 needs a value"
      case "$1" in
        --program) programs+=("$2") ;;
        --domain) domains=$2 ;;
        --days) days=$2 ;;
        --ca-days) ca_days=$2 ;;
        --templates) templates=$2 ;;
        --revoke) revoked=$2 ;;
      esac
      shift 2 ;;
    --renew) renew=true; shift ;;
    --force) force=true; shift ;;
    -h | --help) usage; exit 0 ;;
    -*) fail "unknown option '$1'; --help lists them" ;;
    *) [ -z "$folder" ] || fail "one folder expected, '$folder' and '$1' given"; folder=$1; shift ;;
  esac
done
[ -n "$folder" ] || { usage >&2; exit 2; }
[ ${#programs[@]} -gt 0 ] || programs=(gyrod=daemon sensor=sensor reader=reader)
for number in "$days" "$ca_days"; do
  [[ "$number" =~ ^[1-9][0-9]{0,4}$ ]] || fail "'$number' days given; expected a whole number from 1 to 99999"
done
[[ "$domains" =~ ^([0-9]{1,3})(-([0-9]{1,3}))?$ ]] || fail "--domain is '$domains'; expected a number or two, e.g. 0-230"
first=$((10#${BASH_REMATCH[1]})) last=$((10#${BASH_REMATCH[3]:-${BASH_REMATCH[1]}}))
[ "$first" -le "$last" ] && [ "$last" -le 230 ] || fail "--domain is '$domains'; expected numbers from 0 to 230, the smaller one first"
[ -f "$templates/governance.xml" ] || fail "no governance.xml in --templates '$templates'"
for program in "${programs[@]}"; do
  [[ "$program" =~ ^[A-Za-z0-9_-]{1,64}=[a-z0-9_-]+$ ]] || fail "--program is '$program'; expected NAME=ROLE, a name of letters, digits, '_' and '-'"
  [ "${program%%=*}" != ca ] || fail "--program is '$program'; 'ca' is the authority's folder"
  [ -f "$templates/permissions-${program#*=}.xml" ] || fail "--program is '$program'; no permissions-${program#*=}.xml in '$templates'"
done
command -v openssl >/dev/null || fail "openssl is not installed"

ca=$folder/ca
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

revoke() {  # NAME
  [ -s "$folder/$1/cert.pem" ] && [ -s "$ca/key.pem" ] || fail "--revoke is '$1'; no '$folder/$1/cert.pem', or no authority in '$ca'"
  touch "$ca/index.txt"
  [ -s "$ca/crlnumber" ] || echo 01 >"$ca/crlnumber"
  printf '[ca]\ndefault_ca = authority\n[authority]\ndatabase = %s\ncrlnumber = %s\n' \
    "$ca/index.txt" "$ca/crlnumber" >"$work/crl.cnf"
  local by_authority=(openssl ca -config "$work/crl.cnf" -cert "$ca/cert.pem" -keyfile "$ca/key.pem" -md sha256)
  "${by_authority[@]}" -revoke "$folder/$1/cert.pem" 2>"$work/said" || fail "$(cat "$work/said")"
  "${by_authority[@]}" -gencrl -crldays "$ca_days" -out "$ca/crl.pem" 2>"$work/said" || fail "$(cat "$work/said")"
  local other
  for other in "$folder"/*/; do
    [ -s "$other/permissions.p7s" ] && [ "$(basename "$other")" != "$1" ] || continue
    cp "$ca/crl.pem" "$other/crl.pem"
    echo "${other}crl.pem: without '$1'; its programs read it when they start"
  done
}

if [ -n "$revoked" ]; then
  revoke "$revoked"
  exit 0
fi
$force && rm -rf "$ca"
mkdir -p "$ca"

key_for() {  # FILE: a P-256 key, unless there is one
  if ! $force && [ -s "$1" ]; then return; fi
  openssl genpkey -algorithm EC -pkeyopt ec_paramgen_curve:P-256 -out "$work/key.pem" 2>/dev/null
  mv "$work/key.pem" "$1"
}

describe() {  # FILE: sets subject, as DDS Security compares it (RFC 2253), not_before and not_after, as XML has them
  local line
  while IFS= read -r line; do
    case "$line" in
      subject=*) subject=${line#*=} ;;
      notBefore=*) not_before=$(date -u -d "${line#*=}" +%Y-%m-%dT%H:%M:%SZ) ;;
      notAfter=*) not_after=$(date -u -d "${line#*=}" +%Y-%m-%dT%H:%M:%SZ) ;;
    esac
  done < <(openssl x509 -in "$1" -noout -subject -startdate -enddate -nameopt RFC2253)
}

make_authority() {
  key_for "$ca/key.pem"
  if [ -s "$ca/cert.pem" ]; then return; fi
  cat >"$work/ca.cnf" <<END
[req]
distinguished_name = name
prompt = no
x509_extensions = extensions
[name]
O = gyrod TEST
CN = gyrod TEST authority, not for a vehicle
[extensions]
basicConstraints = critical, CA:true, pathlen:0
keyUsage = critical, keyCertSign, cRLSign, digitalSignature
subjectKeyIdentifier = hash
END
  openssl req -x509 -new -config "$work/ca.cnf" -key "$ca/key.pem" -sha256 -days "$ca_days" -out "$work/cert.pem"
  mv "$work/cert.pem" "$ca/cert.pem"
}

make_certificate() {  # NAME: signed by the authority
  local own=$folder/$1
  key_for "$own/key.pem"
  if ! $renew && [ -s "$own/cert.pem" ] && openssl verify -no_check_time -CAfile "$ca/cert.pem" "$own/cert.pem" >/dev/null 2>&1; then return; fi
  cat >"$work/program.cnf" <<END
[req]
distinguished_name = name
prompt = no
[name]
O = gyrod TEST
CN = $1
[extensions]
basicConstraints = critical, CA:false
keyUsage = critical, digitalSignature
END
  openssl req -new -config "$work/program.cnf" -key "$own/key.pem" -sha256 -out "$work/request.pem"
  openssl x509 -req -in "$work/request.pem" -CA "$ca/cert.pem" -CAkey "$ca/key.pem" -set_serial "0x$(od -An -N16 -tx1 /dev/urandom | tr -d ' \n')" \
    -extfile "$work/program.cnf" -extensions extensions -sha256 -days "$days" -out "$work/cert.pem" 2>/dev/null
  mv "$work/cert.pem" "$own/cert.pem"
}

sign() {  # XML OUT: in clear text, with the authority's signature
  openssl smime -sign -text -in "$1" -signer "$ca/cert.pem" -inkey "$ca/key.pem" -md sha256 -out "$work/signed.p7s"
  mv "$work/signed.p7s" "$2"
}

fill() {  # TEMPLATE NAME=VALUE...: the template with @NAME@ replaced
  local text pair
  text=$(cat "$1")
  shift
  for pair in "$@"; do text=${text//"@${pair%%=*}@"/"${pair#*=}"}; done
  printf '%s\n' "$text"
}

make_authority
domain_set="<id_range><min>$first</min><max>$last</max></id_range>"
fill "$templates/governance.xml" "DOMAINS=$domain_set" >"$work/governance.xml"
sign "$work/governance.xml" "$ca/governance.p7s"

for program in "${programs[@]}"; do
  name=${program%%=*} own=$folder/${program%%=*}
  mkdir -p "$own"
  make_certificate "$name"
  describe "$own/cert.pem"
  fill "$templates/permissions-${program#*=}.xml" "SUBJECT=$subject" "DOMAINS=$domain_set" \
    "NOT_BEFORE=$not_before" "NOT_AFTER=$not_after" >"$work/permissions.xml"
  sign "$work/permissions.xml" "$own/permissions.p7s"
  cp "$ca/governance.p7s" "$own/governance.p7s"
  cp "$ca/cert.pem" "$own/identity_ca.cert.pem"
  cp "$ca/cert.pem" "$own/permissions_ca.cert.pem"
  if [ -s "$ca/crl.pem" ]; then cp "$ca/crl.pem" "$own/crl.pem"; else rm -f "$own/crl.pem"; fi
  echo "$own: $subject, ${program#*=}, domains $domains, until $not_after"
done
