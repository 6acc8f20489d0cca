import "./style.css";
import { showPage, wanted } from "./page";

const place = document.getElementById("page");
const data = document.getElementById("bpms-data");
if (place) showPage(place, data?.textContent ?? "", wanted(location.hash, location.search));
